// Writes the seeds of the fuzzers into the folder given: files of the project's own making.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "estimation/random_tags.h"
#include "experiments/config_keys.h"

using namespace drape;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string tags_as_table() {
  std::string table = "id,category,subcategory,type,composition_percent,areal_density_gsm\n";
  for (const Tag& tag : random_tags(4, 1))
    table += tag.id + "," + tag.category + "," + tag.subcategory + "," + tag.type + "," +
             composition_text(tag.composition) + "," + std::to_string(1e3 * tag.areal_density) +
             "\n";
  return table;
}

/// The bytes of which a FuzzedDataProvider makes these choices in order: it takes them from the
/// end.
std::string choices(std::vector<int> bytes) { return {bytes.rbegin(), bytes.rend()}; }

void append(std::vector<int>& bytes, const std::vector<int>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

/// A share of the range for a number with a fraction.
std::vector<int> share(double of_range) {
  return std::vector<int>(8, static_cast<int>(255 * of_range));
}

/// What fuzz_photograph chooses first: a file or a picture, and 6 mm a pixel.
std::vector<int> photograph_of(bool file) {
  std::vector<int> bytes{file, 0};
  append(bytes, share(5. / 19));
  return bytes;
}

/// A silhouette as PNG or JPEG.
std::string silhouette(const char* format) {
  cv::Mat grey(48, 48, CV_8U, cv::Scalar(0));
  cv::circle(grey, {24, 24}, 20, cv::Scalar(255), cv::FILLED, cv::LINE_AA);
  std::vector<std::uint8_t> bytes;
  cv::imencode(format, grey, bytes);
  return std::string(bytes.begin(), bytes.end()) + choices(photograph_of(true));
}

/// A silhouette with `nodes` folds, drawn by fuzz_photograph itself.
std::string drawn(int nodes, bool png) {
  std::vector<int> bytes = photograph_of(false);
  append(bytes, {47, 47, 255, 0});  // width and height less one, background, cloth
  append(bytes, share(0.5));
  append(bytes, share(0.5));
  append(bytes, {37});  // corners less three
  for (int i = 0; i < 40; ++i)
    append(bytes, {static_cast<int>(std::lround(19 + 2 * std::cos(2 * M_PI * nodes * i / 40)))});
  append(bytes, {0, png});  // nothing more
  return choices(bytes);
}

/// A dictionary for libFuzzer: the names of sections and keys and what they may be.
std::string config_words() {
  std::set<std::string> words;
  for (const ConfigKey& key : config_keys()) {
    words.insert({key.section, key.name});
    words.insert(key.choices.begin(), key.choices.end());
  }
  std::string list;
  for (const std::string& word : words) list += '"' + word + "\"\n";
  return list;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " FOLDER\n";
    return 2;
  }
  const fs::path folder = argv[1];
  write(folder / "tables/tags", tags_as_table());
  write(folder / "tables/parameters",
        "id,type,category,subcategory,composition_percent,density,fSuK,fSvK,fHK,fBuK,fBvK,fBhK,"
        "fBucklingStiffnessU,fBucklingStiffnessV,fBucklingStiffnessH,fBuLR,fBvLR,fBhLR\n"
        "x,Twill,Woven,,Cotton 97; Spandex / Elastane 3,168,1e6,1e6,5e4,20000,2e4,2e4,.8,.8,.8,.3,"
        ".3,.3\n");
  write(folder / "tables/photographs",
        "id,file,mm_per_pixel,areal_density_gsm,specimen_radius_mm,warp_angle_deg,type,"
        "composition_percent\na,1.png,1.39,200,150,90,Twill,Cotton 97; Elastane 3\n"
        "a,2.png,1.39,200,120,90,Twill,Cotton 97; Elastane 3\nb,3.png,1.39,80,,,,\n");
  write(folder / "photograph/png", silhouette(".png"));
  write(folder / "photograph/jpeg", silhouette(".jpg"));
  for (const int nodes : {0, 5, 8})
    write(folder / "photograph" / std::to_string(nodes), drawn(nodes, nodes > 5));
  const std::string nul(1, '\0');
  write(folder / "config/changed", "[experiment]\nkind = 'drape'\n" + nul + "mesh.vertices = auto" +
                                       nul + "fabric.k_u=.5" + nul + "start.protocol=lobes");
  write(folder / "words", config_words());
  // an edit of every sort, in every table, for every reader; choices are read from the end
  for (int table = 0; table < 4; ++table)
    for (int reader = 0; reader < 3; ++reader)
      for (int sort = 0; sort < 8; ++sort) {
        const int number = sort + 8 * (reader + 3 * table);
        std::string bytes(44, '\0');
        for (size_t i = 0; i < bytes.size(); ++i)
          bytes[i] = static_cast<char>(37 * number + static_cast<int>(i * i));
        for (const int choice :
             {sort, 41 * number /* the object */, 0 /* one edit */, reader, table})
          bytes += static_cast<char>(choice);
        write(folder / "records" / std::to_string(number), bytes);
      }
}
