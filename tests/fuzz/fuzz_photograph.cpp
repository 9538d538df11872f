// Photographs: any file and any picture is read or refused as PhotographError, and what is read is
// a silhouette.
//
// The first byte chooses. Files: the other bytes as they are (OpenCV's decoders come first, and
// mostly refuse). Pictures: a disc-like blob with the radii, holes, specks and greys that the bytes
// say, written by OpenCV as PNG or JPEG, so that everything behind the decoder is reached.
#include <fuzzer/FuzzedDataProvider.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "estimation/photograph.h"
#include "tests/fuzz/memory_file.h"

using namespace drape;

namespace {

std::vector<std::uint8_t> picture(FuzzedDataProvider& bytes) {
  const int width = bytes.ConsumeIntegralInRange(1, 64),
            height = bytes.ConsumeIntegralInRange(1, 64);
  const auto background = bytes.ConsumeIntegral<std::uint8_t>(),
             cloth = bytes.ConsumeIntegral<std::uint8_t>();
  cv::Mat grey(height, width, CV_8U, cv::Scalar(background));
  const double x = bytes.ConsumeFloatingPointInRange(0.0, 1.0) * width,
               y = bytes.ConsumeFloatingPointInRange(0.0, 1.0) * height;
  std::vector<cv::Point> corners;
  const int count = bytes.ConsumeIntegralInRange(3, 40);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count, radius = bytes.ConsumeIntegralInRange(0, 40);
    corners.emplace_back(static_cast<int>(x + radius * cos(angle)),
                         static_cast<int>(y + radius * sin(angle)));
  }
  cv::fillPoly(grey, std::vector{corners}, cv::Scalar(cloth));
  for (int more = bytes.ConsumeIntegralInRange(0, 6); more > 0; --more)  // holes, specks, frames
    cv::circle(
        grey, {bytes.ConsumeIntegralInRange(0, width), bytes.ConsumeIntegralInRange(0, height)},
        bytes.ConsumeIntegralInRange(0, 30), cv::Scalar(bytes.ConsumeIntegral<std::uint8_t>()),
        bytes.ConsumeBool() ? cv::FILLED : 1);
  std::vector<std::uint8_t> file;
  cv::imencode(bytes.ConsumeBool() ? ".png" : ".jpg", grey, file);
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  cv::setNumThreads(1);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const fuzz::MemoryFile file("photograph");
  FuzzedDataProvider bytes(data, size);
  const bool as_it_is = bytes.ConsumeBool();
  const double scale = bytes.ConsumeBool() ? bytes.ConsumeFloatingPoint<double>()
                                           : bytes.ConsumeFloatingPointInRange(1e-3, 2e-2);
  const std::vector<std::uint8_t> content =
      as_it_is ? bytes.ConsumeRemainingBytes<std::uint8_t>() : picture(bytes);
  file.write(content.data(), content.size());
  try {
    const Photograph seen = read_photograph(file.path(), scale, Scene{});
    if (!seen.outline.allFinite() || !(seen.profile.minCoeff() > 0) || !(seen.area > 0) ||
        !(seen.coverage.minCoeff() >= 0) || !(seen.coverage.maxCoeff() <= 1))
      __builtin_trap();
  } catch (const PhotographError&) {
  }
  return 0;
}
