// tests/eval/observed_split_test.cpp: open patches, where every vertex's part is known by counting.
#include "eval/surfaces/observed_split.h"

#include <gtest/gtest.h>

#include "eval/made_shapes.h"

namespace softscope {
namespace {

TriangleMesh shiftedSurface(TriangleMesh mesh, const Eigen::Vector3f& by_mm) {
  for (Eigen::Vector3f& v : mesh.vertices_mm) v += by_mm;
  return mesh;
}

ObservedSplit split(const TriangleMesh& reference, const TriangleMesh& test,
                    const TriangleMesh& observed, double reach_mm) {
  return splitByObserved(reference, observed, compareSurfaces(reference, test, {1}), reach_mm);
}

// The reference is a patch of 10 x 10 mm in steps of 1. The test is 0.5 mm above and
// extends 3 mm farther to the right, beyond the patch; the complete patch is observed.
TEST(ObservedSplit, WhatLiesBeyondAnOpenReferenceIsNeitherObservedNorPredicted) {
  const TriangleMesh patch = makeRectangle(10, 10, 10, 10);
  const TriangleMesh test = shiftedSurface(makeRectangle(13, 10, 13, 10), {0, 0, 0.5f});
  const ObservedSplit s = split(patch, test, patch, 2);
  EXPECT_EQ(s.observed_mm.count, 11u * 11) << "columns 0 … 10, those over the rim too";
  EXPECT_NEAR(s.observed_mm.max, 0.5, 1e-6) << "a distance from the rim is no error";
  EXPECT_EQ(s.predicted_mm.count, 0u);
  EXPECT_NEAR(s.beyond_share, 3.0 / 14, 1e-12);
  EXPECT_NEAR(s.test_share, 11.0 / 14, 1e-12);
  EXPECT_NEAR(s.hausdorff.hd_mm, 0.5, 1e-6);
  EXPECT_EQ(s.each_observed[10], 1);
  EXPECT_EQ(s.each_observed[11], 0);
}

// The left half of the patch, columns 0 … 5, was seen as a surface.
TEST(ObservedSplit, AnOpenScanEndsAtItsRim) {
  const TriangleMesh patch = makeRectangle(10, 10, 10, 10);
  const TriangleMesh seen = makeRectangle(5, 10, 5, 10);
  const ObservedSplit s = split(patch, shiftedSurface(patch, {0, 0, 0.5f}), seen, 2);
  EXPECT_NEAR(s.reference_share, 6.0 / 11, 1e-12) << "not also what is within 2 mm of the rim";
  EXPECT_NEAR(s.test_share, 6.0 / 11, 1e-12);
  EXPECT_EQ(s.predicted_mm.count, 5u * 11);
  EXPECT_EQ(s.beyond_share, 0);
}

// Points have no rim: within reach counts.
TEST(ObservedSplit, ScannedPointsReachAsFarAsTheyAreTold) {
  const TriangleMesh patch = makeRectangle(10, 10, 10, 10);
  TriangleMesh seen = makeRectangle(5, 10, 5, 10);
  seen.triangles.clear();
  const ObservedSplit s = split(patch, shiftedSurface(patch, {0, 0, 0.5f}), seen, 2);
  EXPECT_NEAR(s.reference_share, 8.0 / 11, 1e-12) << "columns 0 … 7";
}

TEST(ObservedSplit, AModelThatEndsEarlyLacksTheRest) {
  const TriangleMesh patch = makeRectangle(10, 10, 10, 10);
  const ObservedSplit s = split(patch, makeRectangle(4, 10, 4, 10), patch, 2);
  EXPECT_NEAR(s.not_reconstructed_share, 4.0 / 11, 1e-12) << "columns 7 … 10 of 0 … 10";
  EXPECT_EQ(s.beyond_share, 0) << "the test's rim is no limit of what is known";
}

// Neighbours that face opposite ways have no side between them, but no rim either.
TEST(ObservedSplit, AFlippedTriangleIsNoRim) {
  TriangleMesh patch = makeRectangle(2, 2, 1, 1);
  std::swap(patch.triangles[1][1], patch.triangles[1][2]);
  TriangleMesh test;
  test.vertices_mm = {{1, 1, 0.5f}};  // over the diagonal
  const ObservedSplit s = split(patch, test, patch, 2);
  EXPECT_EQ(s.observed_mm.count, 1u);
  EXPECT_EQ(s.beyond_share, 0);
}

}  // namespace
}  // namespace softscope
