#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "core/support_contact.h"
#include "experiments/model.h"
#include "tests/experiments/small_drape.h"

namespace drape {
namespace {

TEST(FillRecord, KeepsWhatTheWorkFilledIn) {
  Record record;
  EXPECT_EQ(fill_record(record, 3, [&] { record.stats.status = "converged"; }), "");
  EXPECT_EQ(record.id, "3");
  EXPECT_EQ(record.name, "3");
  EXPECT_EQ(record.stats.status, "converged");
}

TEST(FillRecord, AnExceptionIsTheStatusOfARecordWithAnId) {
  Record record;
  const auto work = [&] {
    record.fabric.k_u = 7;
    throw std::runtime_error("the outline cannot be traced");
  };
  EXPECT_EQ(fill_record(record, 12, work), "the outline cannot be traced");
  EXPECT_EQ(record.id, "12");
  EXPECT_EQ(record.stats.status, "the outline cannot be traced");
  EXPECT_EQ(record.fabric.k_u, 7);  // so that the failed fabric is on disk
}

TEST(SolveStats, SaysWhatActedOnASolveThatFailed) {
  Settings settings = test::small_drape();
  settings.solver.max_iterations = 1;
  for (const ContactMode mode : {ContactMode::support, ContactMode::off, ContactMode::automatic}) {
    settings.contact = mode;
    Potential potential = make_potential(make_discretization(settings), settings.fabric, settings);
    const Equilibrium failed = drape(settings, potential).equilibrium;
    ASSERT_FALSE(failed.converged());
    const SolveStats stats = solve_stats(potential, settings.scene, failed);
    EXPECT_EQ(stats.contact, mode == ContactMode::support ? "support" : "off") << name(mode);
    EXPECT_EQ(stats.self_intersections, -1);
  }
}

TEST(SolveStats, SaysThatContactSwitchedOnWhereOnlyTheSecondSolveFailed) {
  const Settings settings = test::small_drape();
  Potential potential = make_potential(make_discretization(settings), settings.fabric, settings);
  Equilibrium second = drape(settings, potential).equilibrium;
  ASSERT_TRUE(second.converged());
  EXPECT_EQ(solve_stats(potential, settings.scene, second).contact, "off");
  potential.set_support(support_contact(settings.scene));
  second.status = EquilibriumStatus::stagnated;
  EXPECT_EQ(solve_stats(potential, settings.scene, second).contact, "support");
}

TEST(Drape, IsSettledWhereTheSettingsSaySo) {
  Settings settings = test::small_drape();
  const auto protocol = [&] {
    Potential potential = make_potential(make_discretization(settings), settings.fabric, settings);
    return drape(settings, potential).equilibrium.protocol;
  };
  const std::string plain = protocol();
  settings.start.settled = true;
  EXPECT_EQ(protocol(), plain + ", settled");
}

}  // namespace
}  // namespace drape
