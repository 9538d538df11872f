#include "estimation/photograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/contour.h"
#include "core/profile.h"

namespace drape {
namespace {

constexpr double kPi = std::numbers::pi;
/// Blobs and holes below this share of the silhouette's area are dust or compression noise.
constexpr double kSpeckShare = 1e-3;
/// Photographs of one instrument disagree by 1 % on their scale; three times that is let through.
constexpr double kScaleTolerance = 0.03;
/// Least difference of the two classes' median greys; JPEG noise in a uniform image stays below 10.
constexpr double kLeastContrast = 32;
/// Below about 18 pixels of radius a fold is narrower than a pixel.
constexpr int kLeastPixels = 1000;
/// Widths of an edge, from a tenth covered to nine tenths, up to which it is sharp: that many
/// pixels, or that share of the silhouette's mean radius. Masks of real drapes have 0.5 to 2.
constexpr double kSharpEdge = 4, kBlurredShare = 0.05;
/// More than any camera's: a damaged file of some hundred bytes may claim nine times as many, and
/// each takes ten bytes of memory.
constexpr size_t kMostPixels = 100'000'000;
/// Grey values further than this from the silhouette's edge are noise.
constexpr int kBand = 2;  // [pixels]
/// Reentrant stretches of a ray shorter than this are not seen.
constexpr double kRayStep = 0.25;  // [pixels]

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw PhotographError(file.string() + ": " + reason);
}

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

/// Whether the end of a JPEG or PNG is missing. Such a JPEG decodes without an error, to a
/// silhouette with a piece cut off.
bool is_cut_short(const std::vector<std::uint8_t>& bytes) {
  const auto contains = [&](std::string_view pattern, size_t from) {
    return std::search(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(),
                       pattern.begin(), pattern.end(), [](std::uint8_t byte, char c) {
                         return byte == static_cast<std::uint8_t>(c);
                       }) != bytes.end();
  };
  if (bytes.size() < 4) return false;
  if (bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N') return !contains("IEND", 4);
  if (bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
  constexpr std::uint8_t kStartOfScan = 0xDA;
  size_t scan = bytes.size() - 1;  // the last one: a thumbnail has a scan and an end of its own
  while (scan > 1 && !(bytes[scan - 1] == 0xFF && bytes[scan] == kStartOfScan)) --scan;
  return !contains("\xFF\xD9", scan);
}

/// The grey image (8 bit). Decoding from memory keeps OpenCV from printing about missing files.
cv::Mat read_grey(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    fail(file, "no such file; a PNG or JPEG is expected");
  std::ifstream stream(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), {});
  if (!stream.is_open() || stream.bad())
    fail(file, "the file cannot be read; check its permissions");
  if (bytes.empty()) fail(file, "the file is empty (0 bytes); a PNG or JPEG is expected");
  if (is_cut_short(bytes)) fail(file, "the image is cut short: its end is missing; copy it again");
  cv::Mat grey;
  try {
    grey = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception& error) {
    fail(file, "the image cannot be decoded (" + error.err + "); a PNG or JPEG is expected");
  }
  if (grey.empty()) fail(file, "not an image, or a damaged one; a PNG or JPEG is expected");
  if (grey.total() > kMostPixels)
    fail(file, text("the image has ", grey.cols, " x ", grey.rows,
                    " pixels; scale it down to at most ", static_cast<double>(kMostPixels)));
  return grey;
}

/// Median grey of the pixels selected by `mask`: unlike the mean it ignores the grey rim.
double median_grey(const cv::Mat& grey, const cv::Mat& mask) {
  std::array<int, 256> histogram{};
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column)
      if (mask.at<std::uint8_t>(row, column)) ++histogram[grey.at<std::uint8_t>(row, column)];
  const int half = (cv::countNonZero(mask) + 1) / 2;
  int value = 0;
  for (int below = histogram[0]; below < half; below += histogram[static_cast<size_t>(value)])
    ++value;
  return value;
}

/// Share of every pixel that is covered (64 bit, not clamped to [0, 1]), whatever the polarity.
cv::Mat covered_share(const std::filesystem::path& file, const cv::Mat& grey) {
  cv::Mat bright;
  cv::threshold(grey, bright, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const cv::Mat dark = ~bright;
  const double high = median_grey(grey, bright), low = median_grey(grey, dark);
  if (cv::countNonZero(bright) == 0 || cv::countNonZero(dark) == 0 || high - low < kLeastContrast)
    fail(file, text("the image is uniform (grey ", low, " to ", high,
                    "), without a silhouette or filled by it; a bright blob on dark ground or the "
                    "reverse is expected"));
  cv::Mat inside = cv::Mat::zeros(grey.size(), CV_8U);
  if (grey.rows > 2 && grey.cols > 2)
    inside(cv::Rect(1, 1, grey.cols - 2, grey.rows - 2)).setTo(255);
  const int border = cv::countNonZero(~inside);
  const bool bright_ground = 2 * cv::countNonZero(bright & ~inside) > border;
  const double ground = bright_ground ? high : low, cloth = bright_ground ? low : high;
  cv::Mat share;
  grey.convertTo(share, CV_64F, 1 / (cloth - ground), -ground / (cloth - ground));
  return share;
}

bool touches_border(const cv::Mat& components, const cv::Mat& stats, int label) {
  const int left = stats.at<int>(label, cv::CC_STAT_LEFT),
            top = stats.at<int>(label, cv::CC_STAT_TOP);
  return left == 0 || top == 0 ||
         left + stats.at<int>(label, cv::CC_STAT_WIDTH) == components.cols ||
         top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == components.rows;
}

/// The one blob of pixels covered by at least a half, its specks of holes filled (8 bit, 0 or 255).
cv::Mat single_blob(const std::filesystem::path& file, const cv::Mat& share) {
  const cv::Mat mask = share >= 0.5;
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8);
  int largest = 1;
  const auto size = [&stats](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
  for (int label = 2; label < count; ++label)
    if (size(label) > size(largest)) largest = label;
  const double speck = kSpeckShare * size(largest);
  std::string others;
  for (int label = 1; label < count; ++label) {
    if (size(label) < speck) continue;
    if (touches_border(labels, stats, label))
      fail(file, "the silhouette touches the image's border; the whole drape must be visible");
    if (label != largest) others += text(others.empty() ? "" : ", ", size(label));
  }
  if (!others.empty())
    fail(file, text("several blobs, of ", size(largest), " and ", others,
                    " pixels; one silhouette is expected (specks below ", 100 * kSpeckShare,
                    " % of it are ignored)"));

  cv::Mat blob = labels == largest;
  const int regions = cv::connectedComponentsWithStats(~blob, labels, stats, centroids, 4);
  for (int label = 1; label < regions; ++label) {
    if (touches_border(labels, stats, label)) continue;
    if (size(label) >= speck)
      fail(file, text("the silhouette has a hole of ", size(label), " pixels at column ",
                      centroids.at<double>(label, 0), ", row ", centroids.at<double>(label, 1),
                      "; a filled mask is expected"));
    blob.setTo(255, labels == label);
  }
  return blob;
}

/// Refuses an edge that fades over many pixels: where it lies is then a guess.
void check_sharpness(const std::filesystem::path& file, const cv::Mat& share, const cv::Mat& blob) {
  cv::Mat inner;
  cv::erode(blob, inner, cv::getStructuringElement(cv::MORPH_CROSS, cv::Size(3, 3)));
  const double rim = cv::countNonZero(blob & ~inner);
  const double width = cv::countNonZero((share > 0.1) & (share < 0.9)) / rim;
  const double largest =
      std::max(kSharpEdge, kBlurredShare * std::sqrt(cv::countNonZero(blob) / kPi));
  if (width > largest)
    fail(file, text("the image is blurred: the silhouette's edge is ", width,
                    " pixels wide; at most ", largest, " are expected"));
}

/// Zero outside of the blob and one inside; in between, in a narrow band, what the grey values say.
CoverageImage clean_coverage(const cv::Mat& share, const cv::Mat& blob) {
  const cv::Mat kernel =
      cv::getStructuringElement(cv::MORPH_RECT, cv::Size(2 * kBand + 1, 2 * kBand + 1));
  cv::Mat outer, inner;
  cv::dilate(blob, outer, kernel);
  cv::erode(blob, inner, kernel);
  CoverageImage coverage(share.rows, share.cols);
  for (int row = 0; row < share.rows; ++row)
    for (int column = 0; column < share.cols; ++column)
      coverage(row, column) = inner.at<std::uint8_t>(row, column) ? 1.0
                              : !outer.at<std::uint8_t>(row, column)
                                  ? 0.0
                                  : std::clamp(share.at<double>(row, column), 0.0, 1.0);
  return coverage;
}

/// Bilinear interpolation at (column, row); nothing is covered outside of the image.
double interpolated(const CoverageImage& coverage, double column, double row) {
  const double c0 = std::floor(column), r0 = std::floor(row), s = column - c0, t = row - r0;
  const auto at = [&](double r, double c) {
    const auto i = static_cast<Eigen::Index>(r), j = static_cast<Eigen::Index>(c);
    return i < 0 || j < 0 || i >= coverage.rows() || j >= coverage.cols() ? 0.0 : coverage(i, j);
  };
  return (1 - t) * ((1 - s) * at(r0, c0) + s * at(r0, c0 + 1)) +
         t * ((1 - s) * at(r0 + 1, c0) + s * at(r0 + 1, c0 + 1));
}

struct Crossings {
  double outermost;  ///< [pixels]
  int count;
};

/// Where the ray from the centroid (column, row) in direction alpha (row counts downwards) crosses
/// 1/2.
Crossings cast_ray(const CoverageImage& coverage, const Vec2& centre, double alpha) {
  const Vec2 direction(std::cos(alpha), -std::sin(alpha));
  const auto inside = [&](double radius) {
    const Vec2 at = centre + radius * direction;
    return interpolated(coverage, at.x(), at.y()) >= 0.5;
  };
  const Vec2 size(static_cast<double>(coverage.cols()), static_cast<double>(coverage.rows()));
  const double far = centre.cwiseMax(size - centre).norm();  // beyond, nothing is covered
  Crossings crossings{0, 0};
  bool was_inside = false;
  for (int step = static_cast<int>(far / kRayStep); step >= 0; --step) {
    if (inside(step * kRayStep) == was_inside) continue;
    was_inside = !was_inside;
    if (crossings.count++ > 0) continue;
    double in = step * kRayStep, out = in + kRayStep;
    while (out - in > 1e-9) {
      const double middle = (in + out) / 2;
      (inside(middle) ? in : out) = middle;
    }
    crossings.outermost = in;
  }
  return crossings;
}

}  // namespace

Photograph read_photograph(const std::filesystem::path& file, double metres_per_pixel,
                           const Scene& scene) {
  validate(scene);
  if (!std::isfinite(metres_per_pixel) || metres_per_pixel <= 0)
    fail(file, text("the scale is ", 1e3 * metres_per_pixel,
                    " mm per pixel; it must be positive and finite"));
  const cv::Mat grey = read_grey(file);
  const cv::Mat share = covered_share(file, grey);
  const cv::Mat blob = single_blob(file, share);
  check_sharpness(file, share, blob);

  Photograph photo;
  photo.metres_per_pixel = metres_per_pixel;
  photo.width = grey.cols;
  photo.height = grey.rows;
  photo.coverage = clean_coverage(share, blob);

  const double pixels = photo.coverage.sum();
  if (pixels < kLeastPixels)
    fail(file, text("the silhouette has only ", pixels, " pixels; at least ", kLeastPixels,
                    " are needed to see folds"));
  photo.area = pixels * metres_per_pixel * metres_per_pixel;
  const double smallest = std::sqrt(kPi / pixels) * scene.support_radius,
               largest = std::sqrt(kPi / pixels) * scene.specimen_radius;  // [m per pixel]
  if (metres_per_pixel < smallest * (1 - kScaleTolerance) ||
      metres_per_pixel > largest * (1 + kScaleTolerance))
    fail(file,
         text("at ", 1e3 * metres_per_pixel, " mm per pixel the silhouette covers ",
              1e4 * photo.area, " cm^2, but a drape lies between its support (",
              1e4 * kPi * scene.support_radius * scene.support_radius, " cm^2) and its specimen (",
              1e4 * kPi * scene.specimen_radius * scene.specimen_radius,
              " cm^2); plausible for this image: ", 1e3 * smallest, " to ", 1e3 * largest,
              " mm per pixel"));

  const VecX columns = VecX::LinSpaced(photo.width, 0, photo.width - 1),
             rows = VecX::LinSpaced(photo.height, 0, photo.height - 1);
  photo.centroid_pixels = {(photo.coverage * columns).sum() / pixels,
                           (photo.coverage.transpose() * rows).sum() / pixels};
  if (interpolated(photo.coverage, photo.centroid_pixels.x(), photo.centroid_pixels.y()) < 0.5)
    fail(file, "the centroid lies outside of the silhouette; a drape covers its support");

  photo.grid.rows = photo.height;
  photo.grid.columns = photo.width;
  photo.grid.pixel_size = metres_per_pixel;
  photo.grid.origin = metres_per_pixel * Vec2(-0.5 - photo.centroid_pixels.x(),
                                              photo.centroid_pixels.y() + 0.5 - photo.height);

  photo.boundary = contour(photo.coverage, photo.grid);
  photo.outline.resize(kOutlineSize, 2);
  photo.profile.resize(kProfileSize);
  int reentrant = 0;
  static_assert(kOutlineSize % kProfileSize == 0);
  constexpr int kStride = kOutlineSize / kProfileSize;
  for (int i = 0; i < kOutlineSize; ++i) {
    const double alpha = 2 * kPi * i / kOutlineSize;
    const Crossings crossings = cast_ray(photo.coverage, photo.centroid_pixels, alpha);
    const double radius = metres_per_pixel * crossings.outermost;
    photo.outline.row(i) << radius * std::cos(alpha), radius * std::sin(alpha);
    if (i % kStride == 0) photo.profile[i / kStride] = radius;
    if (crossings.count > 1) ++reentrant;
  }
  photo.reentrant_share = static_cast<double>(reentrant) / kOutlineSize;
  photo.star_shaped = reentrant == 0;
  return photo;
}

}  // namespace drape
