#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/outline.h"
#include "core/profile.h"
#include "core/profile.h"
#include "core/signed_distance.h"
#include "estimation/photograph.h"

namespace drape {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kScale = 1.39e-3;  // [m per pixel]
constexpr int kPixels = 256;
const Vec2 kCentre(127.3, 129.1);  // (column, row) of the origin of the drawn shapes

/// Radius of a drawn shape in direction alpha [pixels].
using Shape = double (*)(double alpha);
double disc(double) { return 90; }
double folds(double alpha) { return 95 + 9 * std::cos(7 * alpha) + 3 * std::sin(2 * alpha); }
double small_disc(double) { return 50; }

/// Share of each pixel inside the shape, by 16 x 16 samples a pixel at the rim (0 to 255, shape
/// bright).
cv::Mat drawn(Shape shape, const Vec2& centre = kCentre) {
  constexpr int kSamples = 16;
  const auto depth = [&](double column, double row) {
    const double x = column - centre.x(), y = centre.y() - row;
    return shape(std::atan2(y, x)) - std::hypot(x, y);
  };
  cv::Mat image(kPixels, kPixels, CV_8U);
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column) {
      double share = depth(column, row) > 0 ? 1 : 0;
      if (std::abs(depth(column, row)) < 3) {  // the shapes are less steep than 1 : 3
        int inside = 0;
        for (int i = 0; i < kSamples * kSamples; ++i)
          inside += depth(column - 0.5 + (i % kSamples + 0.5) / kSamples,
                          row - 0.5 + (i / kSamples + 0.5) / kSamples) > 0;
        share = static_cast<double>(inside) / (kSamples * kSamples);
      }
      image.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(std::lround(255 * share));
    }
  return image;
}

void draw_disc(cv::Mat& image, double column, double row, double radius, std::uint8_t grey) {
  for (int r = 0; r < image.rows; ++r)
    for (int c = 0; c < image.cols; ++c)
      if (std::hypot(c - column, r - row) < radius) image.at<std::uint8_t>(r, c) = grey;
}

class PhotographTest : public ::testing::Test {
 protected:
  PhotographTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("drape_photo_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~PhotographTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path saved(const cv::Mat& image, const std::string& name = "mask.png") {
    const std::filesystem::path file = folder_ / name;
    cv::imwrite(file.string(), image, {cv::IMWRITE_JPEG_QUALITY, 75});
    return file;
  }
  std::filesystem::path written(const char* name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  Photograph read(const cv::Mat& image) { return read_photograph(saved(image), kScale, Scene{}); }

  /// Expects a PhotographError that begins with the file's name and contains `reason`.
  static void expect_refused(const std::filesystem::path& file, const std::string& reason,
                             double scale = kScale) {
    try {
      read_photograph(file, scale, Scene{});
      ADD_FAILURE() << "accepted; expected: " << reason;
    } catch (const PhotographError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find(file.string()), 0u) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  std::filesystem::path folder_;
};

/// Outline minus drawn radius [pixels], mean and root mean square over all directions.
Vec2 outline_error(const Photograph& photo, Shape shape) {
  double sum = 0, squares = 0;
  for (const auto& point : photo.outline.rowwise()) {
    const double x = point[0] / kScale + photo.centroid_pixels.x() - kCentre.x(),
                 y = point[1] / kScale - photo.centroid_pixels.y() + kCentre.y();
    const double error = std::hypot(x, y) - shape(std::atan2(y, x));
    sum += error;
    squares += error * error;
  }
  return Vec2(sum, 0) / kOutlineSize + Vec2(0, std::sqrt(squares / kOutlineSize));
}

TEST_F(PhotographTest, FindsTheDrawnOutlineInBothPolaritiesAndFormats) {
  for (const Shape shape : {disc, folds})
    for (const bool bright : {true, false})
      for (const char* name : {"mask.png", "mask.jpg"}) {
        SCOPED_TRACE(std::string(name) + (bright ? " bright" : " dark"));
        const cv::Mat image = bright ? drawn(shape) : cv::Mat(255 - drawn(shape));
        const Photograph photo = read_photograph(saved(image, name), kScale, Scene{});
        const Vec2 error = outline_error(photo, shape);
        // Measured .05 to .065: bilinear interpolation across an anti-aliased edge errs by up to
        // .09 pixels, to both sides alike, and quality 75 adds little. A pixel contour has .3.
        EXPECT_LT(error[1], 0.1);
        EXPECT_LT(std::abs(error[0]), 0.01);
        EXPECT_TRUE(photo.star_shaped);
        EXPECT_EQ(photo.width, kPixels);
        EXPECT_EQ(photo.height, kPixels);
      }
}

TEST_F(PhotographTest, MeasuresInMetresAboutTheCentroid) {
  const Photograph photo = read(drawn(disc));
  // Grey levels quantise the covered share to 1/255 in some 700 pixels of the rim.
  EXPECT_LT((photo.centroid_pixels - kCentre).norm(), 1e-3);
  const double exact = kPi * 90 * 90 * kScale * kScale;
  EXPECT_NEAR(photo.area / exact, 1, 1e-4);
  EXPECT_NEAR(area(photo.outline) / exact, 1, 1e-3);  // counter-clockwise; bias below .05 pixels
  ASSERT_EQ(photo.profile.size(), kProfileSize);
  for (int degree = 0; degree < kProfileSize; ++degree)
    EXPECT_DOUBLE_EQ(photo.profile[degree],
                     photo.outline.row(degree * kOutlineSize / kProfileSize).norm());
}

TEST_F(PhotographTest, TurnsTheImageSoThatUpIsPositiveY) {
  const Shape bump = [](double alpha) {  // a lobe at 90 degrees, another half as high at 0
    return 80 + 20 * std::exp(8 * (std::sin(alpha) - 1)) + 10 * std::exp(8 * (std::cos(alpha) - 1));
  };
  const Photograph photo = read(drawn(bump));
  int highest = 0;
  photo.profile.maxCoeff(&highest);
  EXPECT_NEAR(highest, 90, 3);  // the centroid is not the centre of the lobes
  EXPECT_GT(photo.profile[0], photo.profile[180]);
}

TEST_F(PhotographTest, AppliesTheOrientationStoredInTheFile) {
  const Shape lobe = [](double alpha) { return 80 + 20 * std::exp(8 * (std::sin(alpha) - 1)); };
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", drawn(lobe), jpeg);
  // Exif with one entry: orientation 6, to be turned clockwise by a right angle
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0"
      "II*\0\x08\0\0\0\x01\0\x12\x01\x03\0"
      "\x01\0\0\0\x06\0\0\0\0\0\0\0",
      36);
  const std::string plain(jpeg.begin(), jpeg.end());
  const Photograph photo = read_photograph(
      written("turned.jpg", plain.substr(0, 2) + exif + plain.substr(2)), kScale, Scene{});
  int highest = 0;
  photo.profile.maxCoeff(&highest);
  EXPECT_LE(std::min(highest, kProfileSize - highest), 3);  // up in the file, to the right as seen
}

TEST_F(PhotographTest, TheBoundaryOfAStarShapeIsItsOutline) {
  const Photograph photo = read(drawn(folds));
  ASSERT_TRUE(photo.star_shaped);
  const VecX apart = signed_distances(photo.boundary, photo.outline).distance;
  EXPECT_LE(apart.cwiseAbs().maxCoeff(), 0.1 * kScale);  // chords for the bilinear line of a cell
}

TEST_F(PhotographTest, PlacesTheCoverageInTheFrameOfTheOutline) {
  const Photograph photo = read(drawn(folds));
  ASSERT_EQ(photo.coverage.rows(), photo.grid.rows);
  ASSERT_EQ(photo.coverage.cols(), photo.grid.columns);
  // The outline's own exact coverage on that grid: half a pixel of offset would cost .01.
  EXPECT_GT(intersection_over_union(photo.coverage, coverage(photo.outline, photo.grid)), 0.998);
}

TEST_F(PhotographTest, AveragesNothingIntoTheProfileBehindALobe) {
  cv::Mat image = drawn(disc);  // a cut from the side, under an overhanging rim
  for (int row = 60; row < 66; ++row)
    for (int column = 128; column < 256; ++column) image.at<std::uint8_t>(row, column) = 0;
  const Photograph photo = read(image);
  EXPECT_FALSE(photo.star_shaped);
  EXPECT_GT(photo.reentrant_share, 0.03);
  EXPECT_LT(photo.reentrant_share, 0.25);
  EXPECT_NEAR(photo.profile[75] / kScale, 90, 2.5);  // beyond the cut; the centroid moved by 2
}

TEST_F(PhotographTest, IgnoresSpecksAndNoise) {
  cv::Mat image = drawn(folds);
  draw_disc(image, 20, 20, 2.5, 255);      // 21 pixels, below a thousandth of 28000
  draw_disc(image, 128, 128, 2.5, 0);      // a speck of a hole
  for (int row = 0; row < kPixels; ++row)  // a ground that is not quite black
    for (int column = 0; column < kPixels; ++column)
      image.at<std::uint8_t>(row, column) =
          std::max<std::uint8_t>(image.at<std::uint8_t>(row, column),
                                 static_cast<std::uint8_t>((7 * row + 13 * column) % 5));
  const Photograph clean = read(drawn(folds)), photo = read(image);
  EXPECT_LT(outline_error(photo, folds)[1], 0.1);
  EXPECT_NEAR(photo.area / clean.area, 1, 1e-4);  // the grey ground shifts the rim by .01 pixels
}

TEST_F(PhotographTest, RefusesAFileThatIsNoImage) {
  expect_refused(folder_ / "absent.png", "no such file");
  expect_refused(folder_, "no such file");
  expect_refused(written("empty.png", ""), "empty (0 bytes)");
  expect_refused(written("text.png", "this is no image"), "not an image");
  for (const char* name : {"whole.png", "whole.jpg"}) {
    std::ifstream whole(saved(drawn(folds), name), std::ios::binary);
    std::stringstream bytes;
    bytes << whole.rdbuf();
    const std::string half = bytes.str().substr(0, bytes.str().size() / 2);
    expect_refused(written(name, half), "cut short");
  }
}

TEST_F(PhotographTest, RefusesWhatIsNoSilhouette) {
  for (const int grey : {0, 128, 255})
    expect_refused(saved(cv::Mat(kPixels, kPixels, CV_8U, cv::Scalar(grey))), "uniform");
  expect_refused(saved(cv::Mat::zeros(10001, 10000, CV_8U)), "10000 x 10001 pixels");
  cv::Mat faint(kPixels, kPixels, CV_8U, cv::Scalar(100));
  draw_disc(faint, 128, 128, 90, 120);
  expect_refused(saved(faint), "uniform (grey 100 to 120)");

  cv::Mat two = drawn(disc);
  draw_disc(two, 12, 12, 6, 255);
  expect_refused(saved(two), "several blobs");

  expect_refused(saved(drawn(disc, {60, 128})), "touches the image's border");
  cv::Mat full(kPixels, kPixels, CV_8U, cv::Scalar(0));  // ground along three sides only
  full(cv::Rect(5, 5, kPixels - 10, kPixels - 5)).setTo(255);
  expect_refused(saved(full), "touches the image's border");

  cv::Mat hole = drawn(disc);
  draw_disc(hole, 150, 100, 5, 0);
  expect_refused(saved(hole), "a hole of 69 pixels at column 150, row 100");

  cv::Mat crescent = drawn(disc);
  draw_disc(crescent, 150, 129, 75, 0);
  expect_refused(saved(crescent), "centroid", 2.1e-3);

  cv::Mat blurred;
  cv::GaussianBlur(drawn(folds), blurred, {0, 0}, 6);
  expect_refused(saved(blurred), "the image is blurred: the silhouette's edge is");
  cv::GaussianBlur(drawn(folds), blurred, {0, 0}, 1);
  EXPECT_NO_THROW(read(blurred));

  cv::Mat tiny(kPixels, kPixels, CV_8U, cv::Scalar(0));
  draw_disc(tiny, 128, 128, 10, 255);
  expect_refused(saved(tiny), "pixels; at least 1000", 12e-3);
}

TEST_F(PhotographTest, RefusesAnImplausibleScaleAndSaysWhichWouldDo) {
  const std::filesystem::path file = saved(drawn(disc));
  for (const double scale : {0.0, -1e-3, std::nan(""), static_cast<double>(INFINITY)})
    expect_refused(file, "must be positive and finite", scale);
  // A disc of 90 pixels: 1 mm per pixel makes it the support, 1.667 the specimen; 3 % are allowed.
  EXPECT_NO_THROW(read_photograph(file, 0.975e-3, Scene{}));
  expect_refused(file, "plausible for this image: 1 to 1.667 mm per pixel", 0.965e-3);
  EXPECT_NO_THROW(read_photograph(file, 1.71e-3, Scene{}));
  expect_refused(file, "plausible for this image: 1 to 1.667 mm per pixel", 1.73e-3);
  expect_refused(saved(drawn(small_disc)), "plausible for this image: 1.8 to 3 mm per pixel");
}

/// The cells of a comma-separated table with '#' comments, its header left out.
std::vector<std::vector<double>> table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

TEST(RealPhotographs, AgreeWithTheTableMadeFromThem) {
  const char* data = std::getenv("DRAPE_DATA");
  if (data == nullptr || !std::filesystem::exists(std::filesystem::path(data) / "cusick_photos"))
    GTEST_SKIP() << "DRAPE_DATA names no folder with cusick_photos (the Cusick Drape Dataset)";
  const std::filesystem::path folder = data;
  const auto profiles = table(folder / "cusick_photos_radial_profiles.csv"),
             features = table(folder / "cusick_photos_silhouette_features.csv");
  ASSERT_EQ(profiles.size(), features.size());
  ASSERT_FALSE(profiles.empty());
  constexpr size_t kEvery = 40;  // a dozen of the 489 keeps this test below a second
  for (size_t i = 0; i < profiles.size(); i += kEvery) {
    char name[64];
    std::snprintf(name, sizeof name, "fabric_%02.0f/specimen_%02.0f_capture_%.0f.jpg",
                  profiles[i][0], profiles[i][1], profiles[i][2]);
    SCOPED_TRACE(name);
    const Photograph photo =
        read_photograph(folder / "cusick_photos" / name, 1.3964e-3, Scene{});  // the table's scale
    const Eigen::Map<const VecX> expected(profiles[i].data() + 3, kProfileSize);  // [mm]
    const VecX found = 1e3 * photo.profile;
    // The table ignores the orientation flag, which four of the files have set to a half turn.
    VecX turned(kProfileSize);
    turned << found.tail(kProfileSize / 2), found.head(kProfileSize / 2);
    const double rms = std::min((found - expected).norm(), (turned - expected).norm()) /
                       std::sqrt(static_cast<double>(kProfileSize));
    // Measured over all 489: rms .30 median, .80 worst; area .04 % and .21 %; mean radius .06 and
    // .13 mm. The table's radii are steps along a binary mask, about half a pixel wide.
    EXPECT_LT(rms, 1.0);
    EXPECT_NEAR(1e4 * photo.area / features[i][3], 1, 0.003);
    EXPECT_NEAR(found.mean(), features[i][7], 0.2);
    EXPECT_NEAR(node_count(photo.profile), features[i][5],
                1);  // 1.5 mm of prominence is a threshold
  }
}

}  // namespace
}  // namespace drape
