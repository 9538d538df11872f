// One ingredient changed at a time: what the changes are, and that they are followed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/ablation.h"
#include "experiments/model.h"
#include "experiments/peak_memory.h"
#include "tests/experiments/drawn_photograph.h"
#include "tests/experiments/program_fixture.h"
#include "tests/experiments/small_drape.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Settings small_settings() {
  Settings settings = test::small_drape();
  settings.reading.threshold = BendingThreshold::radius;
  settings.fabric.k_bu = 1.2e-5;
  settings.fabric.k_bv = 6e-6;
  settings.fabric.k_bh = 8e-6;
  settings.fabric.s_bu = settings.fabric.s_bv = settings.fabric.s_bh = 0.7;
  return settings;
}

const Ingredient& ingredient(const std::string& name) {
  for (const Ingredient& i : ingredients())
    if (i.name == name) return i;
  throw std::invalid_argument(name);
}

Settings changed(const std::string& name) {
  Settings settings = small_settings();
  ingredient(name).change(settings);
  return settings;
}

const UnchangedDrape& unchanged() {
  static const UnchangedDrape drape(small_settings(), make_discretization(small_settings()));
  return drape;
}

TEST(Ingredients, ChangeWhatTheySay) {
  const Fabric even = changed("isotropic").fabric;
  EXPECT_EQ(even.k_bu, even.k_bh);
  EXPECT_NEAR(std::pow(even.k_bu, 3), 1.2e-5 * 6e-6 * 8e-6, 1e-28);  // rounding
  EXPECT_EQ(changed("mesh_double").mesh.vertices, 600);
  EXPECT_EQ(changed("clamp_factor_1").mesh.clamp_wing_factor, 1);
  EXPECT_EQ(changed("clamp_even").mesh.clamp_refinement, 1);
  EXPECT_EQ(changed("no_softening").fabric.s_bh, 1);
  EXPECT_EQ(changed("other_threshold").reading.threshold, BendingThreshold::printed);
  EXPECT_EQ(changed("secant_law").reading.law, BendingLaw::secant);
  EXPECT_EQ(changed("contact_off").contact, ContactMode::off);
  EXPECT_EQ(changed("shear_soft").fabric.k_h, small_settings().fabric.k_h / 5);
}

TEST(Ingredients, LabelsFitTheirColumnOfTheFigures) {
  const std::string longest = "threshold read otherwise";  // what the figures are tested with
  for (const Ingredient& ingredient : ingredients())
    EXPECT_LE(ingredient.label.size(), longest.size()) << ingredient.label;
}

TEST(Ablation, TheClampFactorIsFollowedThereAndBack) {
  const Settings settings = changed("clamp_factor_1");
  const Json item =
      ablate(unchanged(), ingredient("clamp_factor_1"), make_discretization(settings));
  EXPECT_EQ(item["status"], "converged");
  EXPECT_TRUE(item["followed"].get<bool>());
  EXPECT_LT(item["change"].get<double>(), -1);  // the rim gets too soft: points at this size
  EXPECT_GT(item["outline_rms"].get<double>(), 1e-4);
  EXPECT_GT(item["cpu_ratio"].get<double>(), 0);
}

TEST(Ablation, AFabricIsFollowedAlongItsPath) {
  const Json item =
      ablate(unchanged(), ingredient("no_softening"), make_discretization(changed("no_softening")));
  ASSERT_TRUE(item["followed"].get<bool>()) << item.dump();
  const double change = item["change"].get<double>() - item["snap_change"].get<double>();
  EXPECT_GT(change, 0);  // bent wings get up to 1/0.7 times as stiff
  EXPECT_LT(change, 10);
}

TEST(Ablation, ATightToleranceChangesNothing) {
  const Ingredient tight{"tight", "", AblationWay::tolerance,
                         [](Settings& s) { s.solver.tolerance = 1e-8; }};
  const Json item = ablate(unchanged(), tight, make_discretization(small_settings()));
  EXPECT_LT(std::abs(item["change"].get<double>()), 1e-6);  // both at the same residual
  const Json loose =
      ablate(unchanged(), ingredient("tolerance_1e-2"), make_discretization(small_settings()));
  EXPECT_LT(std::abs(loose["change"].get<double>()), 0.5);
  EXPECT_NE(loose["change"], 0);
}

TEST(Ablation, ContactActsOnSoftFabricsOnly) {
  const Json stiff = check_contact_rule(unchanged());
  EXPECT_FALSE(stiff["acts"].get<bool>());
  EXPECT_FALSE(stiff["needed"].get<bool>());
  Settings settings = small_settings();
  for (Parameter k : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh}) settings.fabric[k] /= 40;
  const Json soft = check_contact_rule(UnchangedDrape(settings, make_discretization(settings)));
  EXPECT_TRUE(soft["acts"].get<bool>()) << soft.dump();
  EXPECT_GT(soft["outline_rms"].get<double>(), 0);
}

TEST(Ablation, FabricsHaveTheCoefficientAskedFor) {
  const Settings settings = small_settings();
  const auto coarse = make_discretization(settings);
  Settings stiffer = settings;
  stiffer.fabric = fabric_of_coefficient(settings, coarse, 90);
  EXPECT_NEAR(UnchangedDrape(stiffer, coarse).seen.coefficient, 90, 3);  // nine bisections
  EXPECT_GT(stiffer.fabric.k_bu, settings.fabric.k_bu);
  EXPECT_NEAR(stiffer.fabric.k_bu / stiffer.fabric.k_bv, 2, 1e-12);  // rounding
}

using AblationOfPhotographs = ProgramInFolder;

TEST_F(AblationOfPhotographs, SaysHowFarDrapesAreFromThem) {
  const std::string picture = "photos/fabric_05/specimen_01_capture_1.png";
  std::filesystem::create_directories((scratch / picture).parent_path());
  scratch.write(picture, silhouette(6));
  scratch.write("a.toml",
                "experiment.kind = \"ablation\"\nmesh.vertices = 300\n"
                "[ablation]\ndrape_coefficients = [85]\nlargest_vertices = 0\n"
                "ingredients = [\"shear_soft\", \"contact_off\"]\n"
                "[photographs]\nfolder = \"photos\"\n[estimate]\nmax_restarts = 0\nmax_moves = "
                "0\nmax_pops = 0\n"
                "[photograph]\nmm_per_pixel = 2.78\nwarp_angles = [90]\noutline_noise = 6e-3\n");
  const Ended ended = drape("run a.toml --out out --threads 1");
  ASSERT_EQ(ended.exit_code, 0) << ended.text;
  const Json all = Json::parse(scratch.read("out/summary.json")), photographs = all["photographs"];
  EXPECT_EQ(all["fabrics"].size(), 1u);
  ASSERT_EQ(photographs["fabrics"].size(), 1u);
  const Json& picture_of_it = photographs["fabrics"][0];
  EXPECT_EQ(picture_of_it["name"], "05_01_1");
  EXPECT_EQ(picture_of_it["node_count"], 6);
  EXPECT_GT(picture_of_it["miss_mm"], 0.1);
  EXPECT_LT(picture_of_it["miss_mm"], 20);  // a drawn drape may not exist
  ASSERT_EQ(photographs["cells"].size(), 2u);
  const Json& sheared = photographs["cells"][0];
  EXPECT_NE(sheared["miss_change"].get<double>(), 0);
  EXPECT_LE(std::abs(sheared["miss_change"].get<double>()), sheared["outline_rms"].get<double>());
  EXPECT_FALSE(all["cells"][0].contains("miss_change"));
  // the outline, in the axes of the fabric, starts the same drape elsewhere
  EXPECT_TRUE(scratch.read("out/outlines/05_01_1.csv").starts_with("x,y\n"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/photographs.png"));
}

TEST(PeakMemory, CountsWhatIsTouchedAndFreed) {
  const double grown = peak_memory_growth([] {
    std::vector<char> block(64 << 20, 1);
    EXPECT_EQ(block[12345], 1);
  });
  if (std::isnan(grown)) GTEST_SKIP() << "the kernel does not reset its mark";
  EXPECT_NEAR(grown, 64 << 20, 2 << 20);  // pages of others
  EXPECT_LT(peak_memory_growth([] {}), 1 << 20);
}

}  // namespace
}  // namespace drape
