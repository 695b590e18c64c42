// tests/toolkit/overlay_finder_test.cpp: what stands still in the image of a moving scope.
#include "toolkit/run/overlay_finder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthMm = 60, kFocalPx = 300;
const PinholeCamera kCamera{320, 240, kFocalPx, kFocalPx, 159.5, 119.5};

/// Blobs of about 6 px; 40 to 160.
double tissueAt(double u, double v) {
  return 100 + 30 * std::sin(u / 3.1 + std::sin(v / 7)) + 30 * std::sin(v / 2.7 + std::sin(u / 9));
}

/// Letters of 4 px strokes in the upper left part.
bool isText(int u, int v) {
  return u >= 40 && u < 120 && v >= 40 && v < 70 && (u % 12 < 4 || v % 14 < 4);
}

enum class Draw { kNothing, kText };

/// From a scope at x_mm over a plane at kDepthMm.
ColourImage viewFrom(double x_mm, Draw overlay, unsigned seed) {
  const double shift_px = kFocalPx * x_mm / kDepthMm;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 3);
  ColourImage image(kCamera.width_px, kCamera.height_px);
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) {
      const double level = overlay == Draw::kText && isText(u, v) ? 235 : tissueAt(u + shift_px, v);
      const auto grey = static_cast<std::uint8_t>(std::clamp(level + noise(random), 0.0, 255.0));
      image.at(u, v) = {grey, grey, grey};
    }
  return image;
}

Eigen::Isometry3d scopeAt(double x_mm) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = x_mm;
  return pose;
}

std::shared_ptr<const Frame> frameOf(const ColourImage& left, const Mask& mask = {}) {
  Frame frame;
  frame.pair.left = left;
  frame.mask = mask;
  return std::make_shared<const Frame>(frame);
}

/// The scope moves by `step_mm` per image; 1 mm is 5 px.
Mask foundAlong(double step_mm, int images, Draw overlay, const Mask& mask = {}) {
  OverlayFinder finder;
  for (int i = 0; i < images; ++i)
    finder.add(frameOf(viewFrom(i * step_mm, overlay, static_cast<unsigned>(i)), mask), kCamera,
               scopeAt(i * step_mm), kDepthMm);
  return finder.found();
}

double shareOf(const Mask& mask) {
  return static_cast<double>(std::count(mask.values.begin(), mask.values.end(), 255)) /
         static_cast<double>(mask.values.size());
}

TEST(OverlayFinder, MarksTextAndNothingElse) {
  const Mask found = foundAlong(1.3, 12, Draw::kText);
  int text = 0, marked = 0, beside = 0;
  for (int v = 0; v < found.height_px; ++v)
    for (int u = 0; u < found.width_px; ++u) {
      const bool is_near = u >= 32 && u < 130 && v >= 32 && v < 78;
      text += isText(u, v);
      marked += isText(u, v) && found.at(u, v) != 0;
      beside += !is_near && found.at(u, v) != 0;
    }
  EXPECT_GT(marked, 0.98 * text);
  EXPECT_EQ(beside, 0);
  EXPECT_THAT(overlayWarning(found, "RUN/m.png"),
              testing::AllOf(testing::HasSubstr(" % of the left image stand still"),
                             testing::HasSubstr("RUN/m.png")));
}

TEST(OverlayFinder, MarksNothingInOrdinaryImages) {
  const Mask found = foundAlong(1.3, 20, Draw::kNothing);
  EXPECT_EQ(shareOf(found), 0);
  EXPECT_EQ(overlayWarning(found, "m.png"), "");
}

TEST(OverlayFinder, SaysNothingWhereTheScopeRestsOrHardlyMoved) {
  EXPECT_EQ(shareOf(foundAlong(0, 20, Draw::kText)), 0);        // nor is resting tissue marked
  EXPECT_EQ(shareOf(foundAlong(1.3, 7, Draw::kText)), 0);       // too few images
  EXPECT_EQ(shareOf(foundAlong(0.05, 40, Draw::kText)), 0);     // 10 px in all
  EXPECT_GT(shareOf(foundAlong(0.25, 60, Draw::kText)), 0.02);  // slow, but far enough
}

TEST(OverlayFinder, LeavesOutMasksBordersAndTheirEdges) {
  Mask mask(kCamera.width_px, kCamera.height_px, 0);
  for (int v = 36; v < 74; ++v) std::fill_n(mask.row(v) + 36, 90, std::uint8_t{1});
  EXPECT_EQ(shareOf(foundAlong(1.3, 12, Draw::kText, mask)), 0);

  OverlayFinder finder;
  for (int i = 0; i < 12; ++i) {
    ColourImage image = viewFrom(1.3 * i, Draw::kNothing, static_cast<unsigned>(i));
    for (int v = 0; v < image.height_px; ++v) {
      std::fill_n(image.row(v), 30, Rgb8{0, 0, 0});
      std::fill_n(image.row(v) + image.width_px - 30, 30, Rgb8{0, 0, 0});
    }
    finder.add(frameOf(image), kCamera, scopeAt(1.3 * i), kDepthMm);
  }
  EXPECT_EQ(shareOf(finder.found()), 0);
}

TEST(OverlayFinder, IgnoresWhatItCannotUse) {
  OverlayFinder finder;
  EXPECT_TRUE(finder.found().empty());
  finder.add(frameOf({}), kCamera, scopeAt(0), kDepthMm);
  finder.add(frameOf(viewFrom(0, Draw::kText, 1)), kCamera, scopeAt(0),
             std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(finder.found().empty());
  for (int i = 0; i < 12; ++i) {
    finder.add(frameOf(viewFrom(1.3 * i, Draw::kText, static_cast<unsigned>(i)), Mask(3, 3, 1)),
               kCamera, scopeAt(1.3 * i), kDepthMm);
    finder.add(frameOf(ColourImage(8, 8)), kCamera, scopeAt(100), kDepthMm);
  }
  EXPECT_GT(shareOf(finder.found()), 0.02);
  EXPECT_EQ(overlayWarning({}, "m.png"), "");
}

/// Bars at a disparity of 6 px, in the way of the tissue.
void paintBars(const fs::path& sequence) {
  for (const char* side : {"left", "right"})
    for (const auto& entry : fs::directory_iterator(sequence / side)) {
      ColourImage image = readColourImage(entry.path());
      const int first = side == std::string("left") ? 40 : 34;
      for (int v = 30; v < 50; ++v)
        for (int u = first; u < first + 60; ++u)
          if ((u - first) % 10 < 4) image.at(u, v) = {235, 235, 120};
      writePng(entry.path(), image, /*overwrite=*/true);
    }
}

TEST(OverlayFinder, ARunNamesTheMaskWithWhichTheNextOneIsRight) {
  const TemporaryFolder folder;
  const fs::path sequence = folder.path() / "clip", run = folder.path() / "run";
  simulateClip(sequence, 24, {"camera.amplitude_mm=28", "camera.period_s=1.6"});
  paintBars(sequence);
  ReconstructOptions options = reconstruction(sequence, run);
  const ReconstructedRun found = reconstructSequence(options);
  EXPECT_THAT(found.record["warnings"].dump(), testing::HasSubstr("overlay_mask.png"));
  const Mask mask = readMask(run / kOverlayFile);
  EXPECT_NE(mask.at(55, 40), 0);
  EXPECT_EQ(mask.at(120, 90), 0);

  options.sequence.setMask(run / kOverlayFile);
  options.out = folder.path() / "masked";
  const ReconstructedRun masked = reconstructSequence(options);
  EXPECT_THAT(masked.record["warnings"].dump(), testing::Not(testing::HasSubstr("overlay_mask")));
  EXPECT_FALSE(fs::exists(options.out / kOverlayFile));
}

}  // namespace
}  // namespace softscope::test
