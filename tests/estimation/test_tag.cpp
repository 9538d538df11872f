#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include "estimation/bending_rigidity.h"
#include "estimation/tag.h"

namespace drape {
namespace {

constexpr const char* kHeader =
    "id,category,subcategory,type,composition_percent,areal_density_gsm\n";

/// The message of the std::invalid_argument that `action` throws, empty if it throws none.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void expect_mentions(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' not in: " << message;
}

class TagTable : public ::testing::Test {
 protected:
  TagTable()
      : file_(std::filesystem::temp_directory_path() /
              ("drape_tags_" + std::to_string(getpid()) + ".csv")) {}
  ~TagTable() override { std::filesystem::remove(file_); }

  std::vector<Tag> read(const std::string& content) {
    std::ofstream(file_, std::ios::binary) << content;
    return read_tag_table(file_);
  }
  std::string refusal_of(const std::string& content) {
    return refusal([&] { read(content); });
  }

  std::filesystem::path file_;
};

Tag tag(const std::string& category, const std::string& composition, double areal_density) {
  return {"X", category, "Plain", "Plain", composition_from_text(composition), areal_density};
}

TEST(Composition, IsReadFibreByFibre) {
  const std::vector<Fibre> fibres =
      composition_from_text("Linen 29; Polyester 68.5 ;Spandex / Elastane 2.5");
  ASSERT_EQ(fibres.size(), 3u);
  EXPECT_EQ(fibres[0].name, "Linen");
  EXPECT_EQ(fibres[1].percent, 68.5);
  EXPECT_EQ(fibres[2].name, "Spandex / Elastane");
}

TEST(Composition, SumsToHundredWithinRounding) {
  EXPECT_EQ(composition_from_text("Silk 88; Spandex / Elastane 11").size(), 2u);  // as printed
  EXPECT_EQ(composition_from_text("A 33; B 33; C 32.5").size(), 3u);  // half a percent a fibre
  expect_mentions(refusal([] { composition_from_text("A 33; B 33; C 32.4"); }),
                  {"sums to 98.4", "100 within 1.5"});
  expect_mentions(refusal([] { composition_from_text("Cotton 60; Wool 41.5"); }),
                  {"sums to 101.5"});
}

TEST(Composition, RefusesWhatIsNoFibre) {
  for (const char* text :
       {"", "Cotton", "100", "Cotton 100;", "Cotton 60 %; Wool 40", "Cotton -5; Wool 105",
        "Cotton 0; Wool 100", "Cotton nan", "Cotton 1e2x"})
    expect_mentions(refusal([&] { composition_from_text(text); }),
                    {std::string("'") + text + "'", "expected 'Name percent'"});
  expect_mentions(refusal([] { composition_from_text("Wool 50; Wool 50"); }),
                  {"'Wool' occurs twice"});
}

TEST_F(TagTable, SkipsCommentsAndEmptyLinesAndReadsSiUnits) {
  const std::vector<Tag> tags =
      read("# source\r\n\r\n" + std::string(kHeader) +
           "# a comment\nA,Woven,Twill,Denim,Cotton 98; Spandex / Elastane 2,340\r\n");
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].id, "A");
  EXPECT_EQ(tags[0].type, "Denim");
  EXPECT_EQ(tags[0].composition[1].percent, 2);
  EXPECT_DOUBLE_EQ(tags[0].areal_density, 0.34);
}

TEST_F(TagTable, NamesFileAndLineOfEveryMistake) {
  const std::string good = "A,Woven,Twill,Denim,Cotton 100,340\n", at = file_.string();
  const std::string start = "# source\n" + std::string(kHeader) + good;
  expect_mentions(refusal_of("id,category\n" + good),
                  {at + ":1: ", "header 'id,category'", "expected 'id,category,subcategory,type,"});
  expect_mentions(refusal_of(start + "B,Woven,Twill,Denim,340\n"),
                  {at + ":4: ", "5 columns", "the 6"});
  expect_mentions(refusal_of(start + "B,Wovn,Twill,Denim,Cotton 100,340\n"),
                  {at + ":4: ", "'Wovn'", "'Woven'", "'Cut & Sew knit'"});
  expect_mentions(refusal_of(start + "\nB,Woven,Twill,Denim,Cotton 90,340\n"),
                  {at + ":5: ", "sums to 90"});
  for (const char* density : {"0.34", "-3", "heavy", "", "340 gsm", "20000", "inf"})
    expect_mentions(refusal_of(start + "B,Woven,Twill,Denim,Cotton 100," + density + "\n"),
                    {at + ":4: ", "grams per square metre", std::string("'") + density + "'"});
  expect_mentions(refusal_of(start + good), {at + ":4: ", "'A' occurs twice"});
  expect_mentions(refusal_of(start + ",Woven,Twill,Denim,Cotton 100,340\n"),
                  {at + ":4: ", "empty id"});
  expect_mentions(refusal_of(kHeader), {at, "no fabric"});
  expect_mentions(refusal([] { read_tag_table("no/such/table.csv"); }),
                  {"no/such/table.csv", "no such file"});
}

TEST(Fig2Table, HoldsTheFifteenFabricsOfTheSource) {
  const std::vector<Tag> tags = read_tag_table(std::filesystem::path(DRAPE_SOURCE_DIR) /
                                               "experiments/tables/fig2_fabrics.csv");
  ASSERT_EQ(tags.size(), 15u);
  EXPECT_EQ(tags.front().id, "A");
  EXPECT_EQ(tags.back().id, "O");
  EXPECT_EQ(tags[3].composition.size(), 3u);
  EXPECT_DOUBLE_EQ(tags[4].areal_density, 0.024);
  for (const Tag& one : tags) EXPECT_NO_THROW(validate(first_parameters(one))) << one.id;
}

TEST(FirstParameters, FollowTheMeasuredRigidityOfTheirWeight) {
  for (const double density : {0.024, 0.2, 0.6}) {
    const Vec3 B = effective_rigidity(first_parameters(tag("Woven", "Cotton 100", density)));
    const double mean = std::exp(-9.285) * std::pow(density, 1.187);
    // Twice the cantilever rigidity, the same in every direction.
    EXPECT_NEAR(B.mean() / mean, 2.0, 1e-10);  // rounding
    EXPECT_NEAR(B[1] / B[0], 1.0, 1e-10);
    EXPECT_NEAR(B[2] / B[0], 1.0, 1e-10);
  }
}

TEST(FirstParameters, TellStructuresApart) {
  const Fabric woven = first_parameters(tag("Woven", "Cotton 100", 0.2)),
               stretch = first_parameters(tag("Woven", "Cotton 97; Spandex / Elastane 3", 0.2)),
               knit = first_parameters(tag("Cut & Sew knit", "Cotton 100", 0.2)),
               coated = first_parameters(tag("Animal alternatives", "Spandex / Elastane 100", 0.2));
  EXPECT_GT(woven.k_u, coated.k_u);
  EXPECT_GT(coated.k_u, knit.k_u);
  EXPECT_LT(stretch.k_u, woven.k_u);  // the elastane runs along the weft only
  EXPECT_EQ(stretch.k_v, woven.k_v);
  EXPECT_EQ(coated.k_h, coated.k_u);  // isotropic
  EXPECT_EQ(woven.k_bu, knit.k_bu);   // bending knows the weight only
  EXPECT_EQ(woven.s_bh, 0.8);
  EXPECT_EQ(woven.t_bh, 0.3);
}

TEST(FirstParameters, RefuseAnUnknownCategoryAndAnImpossibleWeight) {
  expect_mentions(refusal([] { first_parameters(tag("Felt", "Wool 100", 0.2)); }),
                  {"'Felt'", "'Woven'"});
  for (const double density : {0.0, -1.0, std::nan("")})
    expect_mentions(refusal([&] { first_parameters(tag("Woven", "Wool 100", density)); }),
                    {"areal density", "positive"});
}

}  // namespace
}  // namespace drape
