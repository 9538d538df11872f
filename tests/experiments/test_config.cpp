#include <gtest/gtest.h>

#include <fstream>

#include "experiments/config.h"
#include "experiments/config_keys.h"
#include "experiments/config_text.h"
#include "experiments/spelling.h"
#include "tests/experiments/scratch_folder.h"

namespace drape {
namespace {

Settings parse(const std::string& text) { return parse_settings(text, "f.toml", "/base"); }

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string read_error(const std::optional<std::filesystem::path>& file,
                       const std::vector<Assignment>& assignments = {}) {
  try {
    read_settings(file, assignments);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string set_error(const std::string& text) {
  return read_error(std::nullopt,
                    {assignment_from_set("experiment.kind=drape"), assignment_from_set(text)});
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A value that the key allows and that is not its default.
ConfigValue another_value(const ConfigKey& key) {
  const ConfigValue value = key.get(Settings{});
  switch (key.type) {
    case ValueType::boolean:
      return !std::get<bool>(value);
    case ValueType::integer:
      return std::get<std::int64_t>(value) + 3;
    case ValueType::integer_or_auto:
      return std::string(kAuto);
    case ValueType::number:
      for (const double number : {0.1 + 0.2, 10. / 3})
        if (key.range.contains(number)) return number;
      return 100. / 3;
    case ValueType::choice:
      return std::get<std::string>(value) == key.choices.back() ? key.choices.front()
                                                                : key.choices.back();
    case ValueType::text:
      return std::string("Cut & \"Sew\"");
    case ValueType::path:
      return std::string("/tables/a \"b\"\\\tc.csv");
    case ValueType::integers:
      return key.range.contains(5000) ? std::vector<std::int64_t>{5000, 300}
                                      : std::vector<std::int64_t>{50, 3};
    case ValueType::numbers:
      return key.range.contains(1e-7) ? std::vector<double>{1e-3 / 3, 1e-7}
                                      : std::vector<double>{10. / 3, 2};
    case ValueType::choices:
      return std::vector<std::string>{key.choices.back(), key.choices.front()};
    case ValueType::paths:
      return std::vector<std::string>{"/a/b.png", "/a/\"c\".png"};
  }
  return value;
}

TEST(Config, DefaultsComeBack) {
  const Settings defaults;
  for (const ConfigKey& key : config_keys())
    EXPECT_EQ(key.get(parse(write_settings(defaults))), key.get(defaults)) << key.full_name();
}

TEST(Config, EveryKeyComesBackToTheLastBit) {
  Settings settings;
  for (const ConfigKey& key : config_keys()) key.set(settings, another_value(key));
  const Settings read = parse(write_settings(settings));
  for (const ConfigKey& key : config_keys()) {
    EXPECT_EQ(key.get(read), another_value(key)) << key.full_name();
    if (key.choices.size() != 1) {
      EXPECT_NE(key.get(read), key.get(Settings{})) << key.full_name();
    }
  }
}

TEST(Config, KeysReachTheirMembers) {
  const Settings s = parse(
      "[experiment]\nkind = 'robustness'\nseed = 9223372036854775807\n"
      "[fabric]\nk_bv = 3e-6\nbending_threshold = 'radius'\n[scene]\ngravity = 2\n"
      "[mesh]\nvertices = 777\n[estimate]\nparameters = ['k_u', 't_bv']\nguide = [0.5]\n"
      "start = 'continued'\n"
      "[robustness]\nvertices = [400]\n");
  EXPECT_EQ(s.experiment.kind, Kind::robustness);
  EXPECT_EQ(s.experiment.seed, 9223372036854775807u);
  EXPECT_EQ(s.fabric.k_bv, 3e-6);
  EXPECT_EQ(s.reading.threshold, BendingThreshold::radius);
  EXPECT_EQ(s.reading.law, BendingLaw::tangent);
  EXPECT_EQ(s.scene.gravity, 2);
  EXPECT_EQ(s.mesh.vertices, 777);
  EXPECT_EQ(s.estimate.parameters, (std::vector<Parameter>{Parameter::k_u, Parameter::t_bv}));
  EXPECT_EQ(s.estimate.guide, std::vector<double>{0.5});
  EXPECT_EQ(s.estimate.start, EstimateStart::continued);
  EXPECT_EQ(s.robustness.vertices, std::vector<int>{400});
}

TEST(Config, VerticesAreACountOrAuto) {
  EXPECT_EQ(parse("[mesh]\nvertices = 'auto'\n").mesh.vertices, std::nullopt);
  EXPECT_EQ(error_of("[mesh]\nvertices = 'many'\n"),
            "f.toml:2:12: mesh.vertices is a text; must be a whole number >= 200 and <= 1e+06, or "
            "\"auto\"");
  EXPECT_EQ(set_error("mesh.vertices=auto"), "no error");
  EXPECT_EQ(set_error("mesh.vertices=\"auto\""), "no error");
  EXPECT_TRUE(contains(set_error("mesh.tolerance=0"), "must be a finite number > 0 and <= 100"));
  const Assignment automatic = assignment_from_set("mesh.vertices=auto");
  EXPECT_TRUE(contains(
      read_error(std::nullopt, {assignment_from_set("experiment.kind=dataset"), automatic}),
      "--set mesh.vertices=auto: mesh.vertices = \"auto\" is only for kind \"drape\""));
  EXPECT_TRUE(contains(
      read_error(std::nullopt, {assignment_from_set("experiment.kind=drape"),
                                assignment_from_set("start.protocol=ensemble"), automatic}),
      "an ensemble needs a count"));
  EXPECT_TRUE(contains(read_error(std::nullopt, {assignment_from_set("experiment.kind=drape"),
                                                 assignment_from_set("start.protocol=ensemble"),
                                                 assignment_from_set("start.settled=true")}),
                       "--set start.settled=true: start.settled is for one drape"));
}

TEST(Config, UnknownKey) {
  EXPECT_EQ(error_of("[mesh]\nseed = 1\n[solver]\n  tolerence = 1e-8\n"),
            "f.toml:4:3: unknown key 'solver.tolerence'; did you mean 'tolerance'?");
  // The key of another section.
  EXPECT_EQ(error_of("[mesh]\nfactorization = 'eigen'\n"),
            "f.toml:2:1: unknown key 'mesh.factorization'; did you mean 'solver.factorization'?");
  EXPECT_EQ(error_of("[solver]\nxyzzy = 1\n"),
            "f.toml:2:1: unknown key 'solver.xyzzy'; the keys of [solver] are tolerance, "
            "max_iterations, factorization");
}

TEST(Config, UnknownSection) {
  EXPECT_EQ(error_of("[solver]\n\n[slover]\ntolerance = 1\n"),
            "f.toml:3:2: unknown section 'slover'; did you mean 'solver'?");
  EXPECT_TRUE(contains(error_of("[xyzzy]\n"),
                       "f.toml:1:2: unknown section 'xyzzy'; the sections are "
                       "experiment, fabric,"));
  EXPECT_EQ(
      error_of("factorization = 1\n"),
      "f.toml:1:1: unknown key or section 'factorization'; did you mean 'solver.factorization'?");
  EXPECT_TRUE(contains(error_of("solver = 1\n"), "f.toml:1:1: 'solver' is a section"));
  EXPECT_TRUE(contains(error_of("[[solver]]\n"), "'solver' is a section"));
}

TEST(Config, WrongType) {
  EXPECT_EQ(error_of("[solver]\ntolerance = '1e-8'\n"),
            "f.toml:2:13: solver.tolerance is a text; must be a finite number > 0 and <= 1");
  EXPECT_TRUE(
      contains(error_of("[mesh]\nvertices = 1000.0\n"), "f.toml:2:12: mesh.vertices is a "));
  EXPECT_TRUE(contains(error_of("[mesh]\nvertices = 1979-05-27\n"), "is a date or time"));
  EXPECT_TRUE(contains(error_of("[experiment]\nkind = 3\n"), "f.toml:2:8: experiment.kind is a "));
  EXPECT_TRUE(contains(error_of("[estimate]\nguide = true\n"), "must be a list of"));
  EXPECT_TRUE(contains(error_of("[estimate]\nrecords = 1\n"), "must be a list of whole numbers"));
  EXPECT_TRUE(contains(error_of("[estimate]\nrecords = [1,\n 2.5]\n"), "f.toml:3:2: "));
  EXPECT_TRUE(contains(error_of("[mesh.vertices]\na = 1\n"), "mesh.vertices is a section"));
}

TEST(Config, RangesOnBothSidesOfTheirEnds) {
  const auto allowed = [](const std::string& text) { return error_of(text) == "no error"; };
  EXPECT_FALSE(allowed("[solver]\ntolerance = 0"));
  EXPECT_TRUE(allowed("[solver]\ntolerance = 1e-300"));
  EXPECT_TRUE(allowed("[solver]\ntolerance = 1"));
  EXPECT_FALSE(allowed("[solver]\ntolerance = 1.0000001"));
  EXPECT_FALSE(allowed("[fabric]\nt_bu = -1e-300"));
  EXPECT_TRUE(allowed("[fabric]\nt_bu = 0"));
  EXPECT_FALSE(allowed("[mesh]\nvertices = 199"));
  EXPECT_TRUE(allowed("[mesh]\nvertices = 200"));
  EXPECT_FALSE(allowed("[estimate]\nfabrics = 3000000000"));  // more than an int holds
  EXPECT_FALSE(allowed("[mesh]\nrotation = nan"));
  EXPECT_FALSE(allowed("[mesh]\nrotation = -inf"));
  EXPECT_TRUE(allowed("[mesh]\nrotation = -7"));
  EXPECT_EQ(error_of("[fabric]\nk_bu = -2e-6"),
            "f.toml:2:8: fabric.k_bu = -2e-06: must be a finite number > 0 N m");
  EXPECT_EQ(error_of("[start]\nprotocol = 'rump'"),
            "f.toml:2:12: start.protocol = \"rump\": must be one of \"coarse_ramp\", \"lobes\", "
            "\"ramp\", "
            "\"lowering\", \"guided\", \"ensemble\"; did you mean 'ramp'?");
}

TEST(Config, Lists) {
  EXPECT_TRUE(parse("[estimate]\nrecords = []\n").estimate.records.empty());  // all of them
  EXPECT_TRUE(contains(error_of("[estimate]\nparameters = []\n"), "f.toml:2:14: "));
  EXPECT_EQ(error_of("[estimate]\nparameters = ['k_h', 'k_h']\n"),
            "f.toml:2:22: estimate.parameters has \"k_h\" twice");
  EXPECT_TRUE(contains(error_of("[estimate]\nparameters = ['k_h', 'k_w']\n"), "f.toml:2:22: "));
}

TEST(Config, AllMistakesInTheOrderOfTheFile) {
  EXPECT_EQ(error_of("[solver]\ntolerance = 2\n[mesh]\nsed = 1\n"),
            "f.toml:2:13: solver.tolerance = 2: must be a finite number > 0 and <= 1\n"
            "f.toml:4:1: unknown key 'mesh.sed'; did you mean 'seed'?");
}

TEST(Config, DamagedText) {
  for (const char* text :
       {"[\\", "[[\\", "[ \\", "[\\]", "\\", "a.\\", "[a", "[\"", "a = \"", "a = [", "\xff\xfe",
        "[mesh]\nseed = \x80", "a = 1 b", "= 1", "a = [\xcf\x9a", "a = [1,\xe2\xb9\x8e]"}) {
    const std::string error = error_of(text);
    EXPECT_TRUE(error.starts_with("f.toml:1:") || error.starts_with("f.toml:2:")) << error;
  }
  EXPECT_TRUE(contains(error_of("[mesh]\nseed = 1\nseed = 2\n"), "f.toml:3:"));
  EXPECT_TRUE(contains(error_of("[mesh]\n[solver]\n[mesh]\n"), "f.toml:3:"));
}

TEST(Config, NestedTooDeep) {
  std::string keys = "[mesh]\nx";
  for (int i = 0; i < 500; ++i) keys += ".a";
  EXPECT_TRUE(contains(error_of(keys + " = 1"), "f.toml:2:1: unknown key 'mesh.x'"));
  EXPECT_TRUE(contains(error_of(keys + ".a = 1"), "f.toml:2:1: more than 500 dots"));
  EXPECT_TRUE(error_of("[mesh]\nx = " + std::string(10000, '[')).starts_with("f.toml:2:"));
}

TEST(Config, NoDamageOfOneByteCrashes) {
  const std::string whole = "[mesh]\nseed = 1 # c\n[a.'b']\nx = [1.5, {y = \"\\u0041\"}]\n";
  const std::string awkward{'\0', '\n', '\\', '"',    '\'',   '[', ']',
                            '{',  '.',  '=',  '\xff', '\xe2', '9'};
  int refused = 0;
  const auto attempt = [&](const std::string& text) {
    if (error_of(text) != "no error") ++refused;
  };
  for (size_t i = 0; i <= whole.size(); ++i) {
    attempt(whole.substr(0, i));
    for (char c : awkward) {
      attempt(whole.substr(0, i) + c);
      attempt(whole.substr(0, i) + c + whole.substr(i));
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Config, Files) {
  const ScratchFolder scratch;
  EXPECT_TRUE(contains(read_error(scratch / "none.toml"), "none.toml: no such file"));
  EXPECT_TRUE(contains(read_error(scratch.path()), "is a folder"));
  scratch.write("empty.toml", "");
  EXPECT_TRUE(contains(read_error(scratch / "empty.toml"), "empty.toml: is empty"));
  scratch.write("comment.toml", "# nothing\n");
  EXPECT_TRUE(contains(read_error(scratch / "comment.toml"), "experiment.kind is missing"));
  scratch.write("large.toml", std::string(64 * 1024, '\n'));
  EXPECT_TRUE(contains(read_error(scratch / "large.toml"), "experiment.kind is missing"));
  scratch.write("large.toml", std::string(64 * 1024 + 1, '\n'));
  EXPECT_TRUE(contains(read_error(scratch / "large.toml"), "larger than 64 KiB"));
  scratch.write("damaged.toml", "[\\");
  EXPECT_TRUE(contains(read_error(scratch / "damaged.toml"), "damaged.toml:1:2: "));
  EXPECT_TRUE(contains(read_error(scratch / std::string(5000, 'a')), "no such file"));
}

TEST(Config, PathsAreRelativeToTheConfig) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "configs");
  scratch.write("tags.csv", "id\n");
  scratch.write("configs/a.toml",
                "[experiment]\nkind = 'dataset'\n[dataset]\ntable = '../tags.csv'\n");
  const Settings settings = read_settings(scratch / "configs/a.toml");
  EXPECT_EQ(settings.dataset.table, scratch / "tags.csv");
  // The written config no longer depends on where it lies.
  EXPECT_EQ(parse(write_settings(settings)).dataset.table, scratch / "tags.csv");

  scratch.write("configs/b.toml",
                "[experiment]\nkind = 'dataset'\n[dataset]\ntable = 'tags.csv'\n");
  const std::string error = read_error(scratch / "configs/b.toml");
  EXPECT_TRUE(contains(error, "b.toml:4:9: dataset.table: there is no file")) << error;
}

TEST(Config, Assignments) {
  const auto kind = assignment_from_set("experiment.kind=dataset");  // a text without quotes
  const Settings settings =
      read_settings(std::nullopt, {kind, assignment_from_set(" mesh.vertices = 300 "),
                                   assignment_from_set("solver.factorization=\"eigen\""),
                                   assignment_from_set("fabric.areal_density=.2"),
                                   assignment_from_set("robustness.vertices=[300, 400]")});
  EXPECT_EQ(settings.experiment.kind, Kind::dataset);
  EXPECT_EQ(settings.mesh.vertices, 300);
  EXPECT_EQ(settings.solver.factorization, FactorBackend::eigen);
  EXPECT_EQ(settings.fabric.areal_density, 0.2);
  EXPECT_EQ(settings.robustness.vertices, (std::vector<int>{300, 400}));

  EXPECT_EQ(set_error("solver.tolerence=1"),
            "--set solver.tolerence=1: unknown key 'solver.tolerence'; did you mean 'tolerance'?");
  EXPECT_TRUE(contains(set_error("slover.tolerance=1"), "did you mean 'solver'?"));
  EXPECT_TRUE(contains(set_error("tolerance=1"), "lacks its section"));
  EXPECT_TRUE(contains(set_error("solver.tolerance=abc"), "--set solver.tolerance=abc: "));
  EXPECT_TRUE(contains(set_error("solver.tolerance="), "must be a finite number"));
  EXPECT_TRUE(contains(set_error("mesh.vertices=300\nx=1"), "must be one value"));
  EXPECT_TRUE(contains(set_error("mesh.vertices=10"), "must be a whole number >= 200"));
  EXPECT_TRUE(contains(set_error("start.protocol=\xff"), "--set start.protocol"));
  EXPECT_THROW(assignment_from_set("mesh.vertices"), ConfigError);
}

TEST(Config, SettingsMustFitTogether) {
  EXPECT_EQ(set_error("mesh.seed=1"), "no error");
  EXPECT_TRUE(
      set_error("scene.support_radius=0.15").starts_with("--set scene.support_radius=0.15: "));
  EXPECT_TRUE(set_error("scene.specimen_radius=0.05").starts_with("--set scene.specimen_radius"));
  EXPECT_TRUE(contains(set_error("experiment.kind=photograph"), "needs photograph.files"));
  EXPECT_TRUE(contains(set_error("experiment.kind=quickstart"), "needs quickstart.table"));
  EXPECT_TRUE(contains(set_error("dataset.radii=[0.12]"), "only for kind \"dataset\""));
  EXPECT_TRUE(contains(set_error("photograph.prior=tag"), "needs photograph.type"));
  EXPECT_TRUE(contains(set_error("photograph.type=Twill"), "give both"));
  EXPECT_TRUE(
      contains(set_error("experiment.kind=photograph_set"), "needs photograph_set.manifest"));
  EXPECT_EQ(set_error("photograph.specimen_radius_mm=[150, 120, 150]"), "no error");
  EXPECT_EQ(set_error("fabric.bending_law=secant"), "no error");
  EXPECT_TRUE(
      contains(read_error(std::nullopt, {assignment_from_set("experiment.kind=gradient_check"),
                                         assignment_from_set("fabric.bending_law=secant")}),
               "the secant law has no derivative"));

  const ScratchFolder scratch;
  scratch.write("p.png", "x");
  std::vector<Assignment> photo{
      assignment_from_set("experiment.kind=photograph"),
      assignment_from_set("photograph.files=['" + (scratch / "p.png").string() + "']")};
  EXPECT_TRUE(contains(read_error(std::nullopt, photo), "needs photograph.mm_per_pixel > 0"));
  photo.push_back(assignment_from_set("photograph.mm_per_pixel=1.39"));
  EXPECT_TRUE(contains(read_error(std::nullopt, photo), "needs photograph.areal_density > 0"));
  photo.push_back(assignment_from_set("photograph.areal_density=.2"));
  EXPECT_EQ(read_error(std::nullopt, photo), "no error");
  photo.push_back(assignment_from_set("photograph.specimen_radius_mm=[120]"));
  photo.push_back(assignment_from_set("photograph.camera_height_mm=1200"));
  EXPECT_EQ(read_error(std::nullopt, photo), "no error");
  photo.push_back(assignment_from_set("photograph.specimen_radius_mm=[120, 150]"));
  EXPECT_TRUE(contains(read_error(std::nullopt, photo), "holds 2 radii for 1 files"));
}

TEST(Config, ADensityInGramsIsRecognised) {
  for (const char* key :
       {"fabric.areal_density", "photographs.areal_density", "quickstart.areal_density"})
    EXPECT_TRUE(contains(set_error(std::string(key) + "=200"), "if it is in g/m^2, write 0.2"))
        << key;
  EXPECT_EQ(set_error("fabric.areal_density=3"), "no error");
}

TEST(Config, ExplainKnowsEveryKey) {
  const std::string all = explain("");
  for (const ConfigKey& key : config_keys()) {
    EXPECT_TRUE(contains(all, "  " + key.name + " = ")) << key.full_name();
    EXPECT_TRUE(contains(explain(key.full_name()), key.explanation)) << key.full_name();
    EXPECT_TRUE(contains(explain(key.section), key.name)) << key.full_name();
  }
  EXPECT_TRUE(contains(explain("table"), "dataset.table"));
  EXPECT_TRUE(contains(explain("table"), "quickstart.table"));
  EXPECT_TRUE(contains(explain("k_bu"), "N m"));
  EXPECT_THROW(explain("solver.tolerence"), std::invalid_argument);
  EXPECT_THROW(explain("xyzzy"), std::invalid_argument);
}

TEST(Config, DifferencesIgnoreThreads) {
  Settings a, b;
  b.experiment.threads = 7;
  EXPECT_EQ(differences(a, b), "");
  b.mesh.vertices = 500;
  EXPECT_EQ(differences(a, b), "mesh.vertices = 2000, here 500");
}

TEST(Spelling, EditDistance) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("seed", "seed"), 0);
  EXPECT_EQ(edit_distance("tolerence", "tolerance"), 1);
  EXPECT_EQ(edit_distance("slover", "solver"), 1);  // a swap
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Spelling, NearestIsNearEnough) {
  const std::vector<std::string> known{"seed", "rotation", "k_u"};
  EXPECT_EQ(nearest("sed", known), "seed");
  EXPECT_EQ(nearest("rotatoin", known), "rotation");
  EXPECT_EQ(nearest("k_v", known), "k_u");
  EXPECT_EQ(nearest("xyzzy", known), std::nullopt);
  EXPECT_EQ(nearest("", known), std::nullopt);
}

TEST(Config, NamesOnlyFactorizationsThatWereBuiltIn) {
  const auto read = [](const std::string& backend) {
    return read_settings(std::nullopt, {assignment_from_set("experiment.kind=drape"),
                                        assignment_from_set("solver.factorization=" + backend)});
  };
  EXPECT_EQ(read("eigen").solver.factorization, FactorBackend::eigen);
#ifdef DRAPE_WITH_CHOLMOD
  EXPECT_EQ(read("cholmod").solver.factorization, FactorBackend::cholmod);
#else
  EXPECT_THROW(read("cholmod"), ConfigError);
#endif
}

}  // namespace
}  // namespace drape
