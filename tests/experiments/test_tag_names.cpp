#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/tag_names.h"
#include "experiments/tag_report.h"

namespace drape {
namespace {

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TagNames, EveryNameIsItself) {
  for (const FabricType& type : fabric_types()) EXPECT_EQ(&type_from_text(type.name), &type);
  for (const FibreKind& kind : fibre_kinds()) EXPECT_EQ(&fibre_from_text(kind.name), &kind);
}

TEST(TagNames, AreMatchedWhateverTheSpelling) {
  for (const auto& [written, name] :
       std::vector<std::pair<const char*, const char*>>{{"jersey", "Jersey"},
                                                        {"JERSEYS", "Jersey"},
                                                        {"crepe", "Crepe / CDC"},
                                                        {"double-knit", "Double knit / Interlock"},
                                                        {"interlocks", "Double knit / Interlock"},
                                                        {"velvet", "Velvet"},
                                                        {"velveteen", "Velvet / Velveteen"},
                                                        {"faux leather", "Vegan leather"},
                                                        {"canvas", "Canvas"}})
    EXPECT_EQ(type_from_text(written).name, name) << written;
  for (const auto& [written, name] : std::vector<std::pair<const char*, const char*>>{
           {"spandex", "Spandex / Elastane"},
           {"Elastane", "Spandex / Elastane"},
           {"lycra", "Spandex / Elastane"},
           {"polyester (recycled)", "Recycled polyester"},
           {"Polyamide", "Nylon"},
           {"viscose", "Viscose rayon"},
           {"Tencel(TM)", "TENCEL"},
           {"pes", "Polyester"},
           {"cottons", "Cotton"}})
    EXPECT_EQ(fibre_from_text(written).name, name) << written;
}

TEST(TagNames, NameTheNearestOrAll) {
  EXPECT_EQ(error_of([] { type_from_text("Jersy"); }),
            "unknown type 'Jersy'; did you mean 'Jersey'?");
  EXPECT_EQ(error_of([] { fibre_from_text("Poliester"); }),
            "unknown fibre 'Poliester'; did you mean 'Polyester'?");
  const std::string all = error_of([] { fibre_from_text("kryptonite"); });
  EXPECT_NE(all.find("known are Acetate, Acrylic"), std::string::npos) << all;
  EXPECT_NE(error_of([] { type_from_text(""); }).find("known are"), std::string::npos);
}

TEST(TagNames, OfCompositions) {
  const std::vector<Fibre> fibres = composition_from_words("cotton 59 %, Lycra 41");
  ASSERT_EQ(fibres.size(), 2u);
  EXPECT_EQ(fibres[0].name, "Cotton");
  EXPECT_EQ(fibres[1].name, kElastane);
  const auto refused = [](const char* text) {
    return error_of([text] { composition_from_words(text); });
  };
  EXPECT_NE(refused("Lycra 50, elastane 50").find("occurs twice; add its percents"),
            std::string::npos);
  EXPECT_NE(refused("Cotton 60, Modal 20").find("sums to 80 percent"), std::string::npos);
  EXPECT_NE(refused("Cotton 120").find("up to 100"), std::string::npos);
  EXPECT_NE(refused("Cotton").find("is no fibre"), std::string::npos);
}

TEST(TagReport, ShowsEveryParameterAndChecksTheDensity) {
  const auto report = [](double density) {
    return tag_report(tag_from_words("jerseys", "Cotton 59, Modal 41", density),
                      BendingThreshold::radius);
  };
  const std::string usual = report(0.104);
  for (Parameter p : all_parameters())
    EXPECT_NE(usual.find("\n" + std::string(name(p)) + " "), std::string::npos) << name(p);
  EXPECT_EQ(usual.find("most weigh"), std::string::npos);
  EXPECT_NE(report(0.5).find("Of this type most weigh 0.09 to 0.22"), std::string::npos);
  EXPECT_NE(error_of([&] { report(104); }).find("if it is in g/m^2, write 0.104"),
            std::string::npos);
  EXPECT_NE(error_of([&] { report(0); }).find("must be positive"), std::string::npos);
}

}  // namespace
}  // namespace drape
