// The accounts of the kinds work_precision and stability, and the hard cases of the latter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "benchmarks/baselines/methods.h"
#include "core/bending.h"
#include "core/drape_protocol.h"
#include "core/equilibrium.h"
#include "core/sparse_factor.h"
#include "experiments/hard_cases.h"
#include "experiments/json_store.h"
#include "experiments/stability_report.h"
#include "experiments/work_precision_report.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Json made_up_run(const std::string& outcome, double pace) {
  return {{"outcome", outcome},
          {"smallest_residual", 1e-3},
          {"same_minimum_as_core", true},
          {"trace",
           {{"cpu_seconds", {0.0, 0.1 * pace, 0.2 * pace, 0.4 * pace}},
            {"residual", {10.0, 1e-3, 0.1, 1e-3}},
            {"rms_mm", {5.0, 0.5, 0.05, nullptr}}}}};
}

TEST(WorkPrecisionReport, TimeWithinAToleranceIsForGood) {
  const Json run = made_up_run("converged", 1);
  EXPECT_EQ(time_within(run, "residual", 10), 0);
  EXPECT_EQ(time_within(run, "residual", 1), 0.1);
  EXPECT_EQ(time_within(run, "residual", 1e-2), 0.4);  // left again at 0.2
  EXPECT_EQ(time_within(run, "residual", 1e-4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(time_within(run, "rms_mm", 1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(time_within(made_up_run("diverged", 1), "residual", 10),
            std::numeric_limits<double>::infinity());
}

TEST(WorkPrecisionReport, CurvesAreMediansOverRuns) {
  const ComparedRuns compared{
      "core", "ours", {made_up_run("converged", 1), made_up_run("converged", 2)}};
  const Json curve = error_curve(compared, "residual", 10);
  EXPECT_EQ(curve["median"].front(), 10);
  EXPECT_EQ(curve["outcomes"], (Json{"converged", "converged"}));
  EXPECT_EQ(curve["cpu_seconds"].back(), 0.8);  // where the longer run ends
  EXPECT_EQ(curve["high"].back(), 1e-3);
  size_t i = 0;
  while (curve["cpu_seconds"][i].get<double>() < 0.1) ++i;
  EXPECT_EQ(curve["low"][i], 1e-3);
  EXPECT_EQ(curve["high"][i], 10);
  EXPECT_NEAR(curve["median"][i].get<double>(), 5.0005, 1e-12);  // rounding
  EXPECT_EQ(error_curve(compared, "residual", 0.3)["cpu_seconds"].back(), 0.3);
}

TEST(WorkPrecisionReport, NamesTheCheapestMethod) {
  const Json slow = account({"core", "ours", {made_up_run("converged", 4)}});
  const Json fast = account({"other", "theirs", {made_up_run("converged", 1)}});
  EXPECT_EQ(slow["outcomes"]["converged"], 1);
  const Json best = cheapest({{"core", slow}, {"other", fast}});
  ASSERT_FALSE(best.empty());
  EXPECT_EQ(best[0]["method"], "other");
  EXPECT_EQ(best[0]["tolerance"], 1);
  EXPECT_EQ(best[0]["core_over_cheapest"], 4);
}

TEST(WorkPrecisionReport, HalfOfTheRunsMustGetThere) {
  Json stuck = made_up_run("stalled", 1);
  stuck["trace"]["residual"] = {10.0, 10.0, 10.0, 10.0};
  const Json row = account({"core", "ours", {made_up_run("converged", 1), stuck}});
  EXPECT_TRUE(std::isinf(row["time_to_residual"][1]["cpu_seconds"].get<double>()));
  EXPECT_EQ(row["outcomes"]["stalled"], 1);
}

TEST(StabilityReport, CountsEveryCellOnce) {
  const auto cell = [](const char* problem, double ratio, double step, const char* outcome) {
    return Json{{"method", "xpbd"},
                {"case", problem},
                {"vertices", 250},
                {"areal_density", 0.2},
                {"membrane_to_bending", ratio},
                {"time_step", step},
                {"smallest_residual", 1e-9 * ratio},
                {"outcome", outcome}};
  };
  const Json all =
      account_of_methods({cell("map", 1e4, 0, "converged"), cell("map", 1e5, 0, "stalled"),
                          cell("map", 1e5, 1e-3, "diverged"), cell("needles", 0, 0, "converged")});
  ASSERT_EQ(all.size(), 1);
  const Json& row = all["xpbd"];
  EXPECT_EQ(row["outcomes"], (Json{{"converged", 2}, {"stalled", 1}, {"diverged", 1}}));
  const Json& axes = row["axes"];
  EXPECT_EQ(axes["membrane_to_bending"]["1e4"]["converged"], 1);
  EXPECT_EQ(axes["membrane_to_bending"]["1e5"]["cells"], 1);
  EXPECT_EQ(axes["time_step"]["0.001"]["converged"], 0);
  EXPECT_EQ(axes["case"]["needles"]["converged"], 1);
  const std::string words = paragraph(row);
  for (const char* said :
       {"XPBD: Converged in 2 of 4 runs. By vertices 1/2 at 250; by membrane over bending 1/1 at "
        "1e4, 0/1 at 1e5; by density [kg/m²] 1/2 at 0.2; by time step given [s] 0/1 at 0.001. Hard "
        "cases reached: needles. The others: ",
        "1 stalled (smallest residual 0.0001)", "1 diverged (smallest residual 0.0001)."})
    EXPECT_NE(words.find(said), std::string::npos) << said << "\n" << words;
}

TEST(StabilityReport, SaysWhyOnlyOfMethodsThatFailed) {
  const auto cell = [](const char* method, const char* outcome, Json residual) {
    return Json{{"method", method},
                {"case", "near_snap"},
                {"smallest_residual", residual},
                {"outcome", outcome}};
  };
  const Json all =
      account_of_methods({cell("core", "converged", 1e-9), cell("xpbd", "stalled", 5.13e-6),
                          cell("xpbd", "stalled", 512), cell("xpbd", "diverged", nullptr)});
  EXPECT_EQ(paragraph(all["core"]), "this solver: Converged in all of 1 runs.");
  const std::string words = paragraph(all["xpbd"]);
  const std::string measured =
      "XPBD: Converged in none of 3 runs: 2 stalled (smallest residual 5.1e-6 to 510), 1 "
      "diverged. ";
  ASSERT_EQ(words.substr(0, measured.size()), measured);
  EXPECT_EQ(words.substr(measured.size()), baselines::methods().back().limits);
}

TEST(HardCases, AreWhatTheyAreCalled) {
  Settings settings;
  settings.start.lobes = 6;
  const auto problem = [&](const char* name) { return hard_case(name, settings, 250); };
  double thinnest = 1;
  const Problem needles = problem("needles");
  for (int t = 0; t < needles.potential.mesh().triangle_count(); ++t) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(
          longest,
          (needles.potential.mesh().rest_uv.row(needles.potential.mesh().triangles(t, k)) -
           needles.potential.mesh().rest_uv.row(needles.potential.mesh().triangles(t, (k + 1) % 3)))
              .norm());
    const double area = needles.potential.mesh().rest[static_cast<size_t>(t)].area;
    thinnest = std::min(thinnest, 2 * area / (longest * longest));
  }
  EXPECT_NEAR(thinnest, 1e-3, 1e-9);  // rounding of an area
  EXPECT_EQ(problem("vanishing_bending").potential.fabric().k_bu, 1e-12);
  EXPECT_EQ(problem("secant").potential.reading().law, BendingLaw::secant);
  const Problem stiffening = problem("threshold_stiffening");
  const Equilibrium drape = solve_equilibrium(stiffening.potential, stiffening.start);
  const int past = stiffening.potential.wings_past_threshold(drape.x);
  EXPECT_GT(past, 0);
  EXPECT_LT(past, static_cast<int>(stiffening.potential.mesh().wings.size()));
  const Fabric stiff = make_fabric(settings.scene, 1e8, 0.3);
  EXPECT_NEAR(stiff.k_u * 0.06 * 0.06 / (4 * stiff.k_bh), 1e8, 1);  // rounding
  EXPECT_EQ(stiff.areal_density, 0.3);
}

const baselines::Method& method(std::string_view name) {
  return *std::ranges::find(baselines::methods(), name, &baselines::Method::name);
}

TEST(HardCases, ALineSearchStopsAtAJumpOfTheEnergy) {
  Settings settings;
  settings.mesh.clamp_refinement = 1;
  settings.start.phase = 0.1;
  const Problem secant = hard_case("secant", settings, 250);
  const Potential& E = secant.potential;
  const baselines::MethodRun stopped =
      baselines::run(method("projected_newton"), E, secant.start, {.cpu_seconds = 20});
  ASSERT_EQ(stopped.outcome, baselines::Outcome::stalled);
  const VecX& x = stopped.end().x;
  const VecX g = E.gradient(x);
  SparseMatrix H;
  E.hessian(x, 1, H);
  SparseFactor factor(E.discretization().symbolic_factor());
  ASSERT_TRUE(factor.factorize(H));
  VecX d = -E.discretization().to_free(g);
  factor.solve_in_place(d);
  const VecX step = E.discretization().to_full(d);
  EXPECT_LT(g.dot(step), 0);
  const auto rise = [&](double length) { return E.energy(x + length * step) - E.energy(x); };
  EXPECT_GT(rise(1e-4), 1e-7);  // the same however short the step
  EXPECT_NEAR(rise(1e-6), rise(1e-4), 1e-2 * rise(1e-4));
}

TEST(HardCases, NothingKeepsANeedleFromCollapse) {
  Settings settings;
  settings.start.phase = 0.1;
  const Problem needles = hard_case("needles", settings, 250);
  const Mesh& mesh = needles.potential.mesh();
  const auto thinnest = [&](const VecX& x) {  // height over the longest edge
    double least = 1;
    for (const auto& t : mesh.triangles.rowwise()) {
      const Vec3 a = position(x, t[1]) - position(x, t[0]),
                 b = position(x, t[2]) - position(x, t[0]);
      least = std::min(least, a.cross(b).norm() / std::max({a.squaredNorm(), b.squaredNorm(),
                                                            (a - b).squaredNorm()}));
    }
    return least;
  };
  const auto end = [&](const char* name) {
    return baselines::run(method(name), needles.potential, needles.start, {.cpu_seconds = 20});
  };
  const baselines::MethodRun collapsed = end("lbfgs"), core = end("core");
  EXPECT_EQ(collapsed.outcome, baselines::Outcome::stalled);
  EXPECT_LT(thinnest(collapsed.end().x), 1e-6);
  EXPECT_EQ(core.outcome, baselines::Outcome::converged);
  EXPECT_GT(thinnest(core.end().x), 5e-4);
}

TEST(HardCases, NearSnapTheSmallestEigenvalueIsSmall) {
  Settings settings;
  settings.start.phase = 0.1;  // as in the config
  const Problem snap = hard_case("near_snap", settings, 250);
  const Equilibrium before = solve_equilibrium(snap.potential, snap.start, {.tolerance = 1e-9});
  ASSERT_TRUE(before.converged());
  Potential stiffer = snap.potential;
  Fabric fabric = stiffer.fabric();
  for (Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) fabric[k] *= 1.2;
  stiffer.set_fabric(fabric);
  const Equilibrium away = solve_equilibrium(stiffer, snap.start, {.tolerance = 1e-9});
  ASSERT_TRUE(away.converged());
  EXPECT_LT(smallest_eigenvalue(before), 0.5 * smallest_eigenvalue(away));
}

}  // namespace
}  // namespace drape
