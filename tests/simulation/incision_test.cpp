// tests/simulation/incision_test.cpp: a cut is invisible until it opens, then as wide as it says.
#include "eval/simulation/wound/incision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/simulation/sequence/simulator.h"
#include "mesh/mesh_check.h"
#include "simple_shapes.h"

namespace softscope {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The scope looks at (0, 0, top) along -z; y of the organ is up.
Eigen::Isometry3d viewFrom(double top_mm) {
  Eigen::Isometry3d body_from_view = Eigen::Isometry3d::Identity();
  body_from_view.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  body_from_view.translation().z() = top_mm;
  return body_from_view;
}

CutOptions cutOf(double length_mm, double opening_mm, double depth_mm, double angle_deg = 0) {
  CutOptions cut;
  cut.length_mm = length_mm;
  cut.opening_mm = opening_mm;
  cut.depth_mm = depth_mm;
  cut.angle_deg = angle_deg;
  cut.start_s = 0.4;
  cut.duration_s = 0.4;
  return cut;
}

/// Pairs of skin vertices that lie on each other while the cut is closed.
std::vector<std::pair<int, int>> lipsOf(const TissueBody& body) {
  const auto placeOf = [&](int i) {
    const Eigen::Vector3f& p = body.mesh.vertices_mm[i];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<int> skin;
  for (std::size_t i = 0; i < body.depth_mm.size(); ++i)
    if (body.depth_mm[i] == 0) skin.push_back(int(i));
  std::sort(skin.begin(), skin.end(), [&](int i, int j) { return placeOf(i) < placeOf(j); });
  std::vector<std::pair<int, int>> lips;
  for (std::size_t k = 1; k < skin.size(); ++k)
    if (placeOf(skin[k - 1]) == placeOf(skin[k])) lips.emplace_back(skin[k - 1], skin[k]);
  return lips;
}

SimulationOptions smallIncision() {
  SimulationOptions options;
  options.scope.width_px = 160;
  options.scope.height_px = 120;
  options.organ.cells_per_side = 30;
  options.camera.tremor_mm = 0;
  options.texture.vessels.trunk_radius_mm = 0;  // they take longest to grow
  return options;
}

SimulationOptions stillOptions() {
  SimulationOptions options = smallIncision();
  options.deformation.breathing.amplitude_mm = options.deformation.heartbeat.amplitude_mm =
      options.deformation.push.amplitude_mm = 0;
  options.camera.path = "still";
  options.sensor.noise = options.sensor.shot_noise = 0;
  return options;
}

/// Meshes finer and coarser than the cut, and one whose vertices lie on its line.
struct Organ {
  const char* name;
  TriangleMesh mesh;
  double top_mm;
};
std::vector<Organ> organs() {
  TriangleMesh box = test::makeSphere(20, 4);
  for (Eigen::Vector3f& p : box.vertices_mm) p = 20 * p.array() / p.cwiseAbs().maxCoeff();
  return {{"fine sphere", test::makeSphere(20, 40), 20},
          {"coarse sphere", test::makeSphere(20, 6), 20},
          {"box of large triangles", box, 20},
          {"built-in organ", makeOrganMesh({60, 30, 3, 1.4}, 2), 18}};
}

TEST(Incision, LeavesAClosedSurfaceWithoutFlaws) {
  for (const Organ& organ : organs())
    for (const double angle_deg : {0.0, 20.0, 45.0, 213.0}) {
      SCOPED_TRACE(std::string(organ.name) + ", " + std::to_string(angle_deg) + " degrees");
      TissueBody body = cutTissue(organ.mesh, cutOf(12, 4, 3, angle_deg), viewFrom(organ.top_mm));
      for (const float open : {0.0F, 1.0F}) {
        TriangleMesh now = body.mesh;
        now.vertices_mm = body.verticesAt(organ.mesh.vertices_mm, open);
        const MeshCheck check = checkMesh(now);
        EXPECT_TRUE(meshWarnings(check).empty()) << meshWarnings(check)[0];
        EXPECT_EQ(check.components, 1u);
        // A closed cut takes nothing away: 1e-5 of the volume is rounding of float.
        const double was_mm3 = checkMesh(organ.mesh).volume_mm3;
        if (open == 0) {
          EXPECT_NEAR(check.volume_mm3, was_mm3, 1e-5 * was_mm3);
        }
        for (const Eigen::Vector3f& normal : body.normalsOf(now.vertices_mm))
          EXPECT_TRUE(normal.allFinite());
      }
    }
}

TEST(Incision, PartsItsLipsByTheOpeningAsALens) {
  for (const Organ& organ : organs()) {
    SCOPED_TRACE(organ.name);
    const TissueBody body = cutTissue(organ.mesh, cutOf(12, 4, 3), viewFrom(organ.top_mm));
    const auto lips = lipsOf(body);
    ASSERT_GE(lips.size(), 8u);
    const auto open = body.verticesAt(organ.mesh.vertices_mm, 1);
    float widest_mm = 0;
    for (const auto& [i, j] : lips) {
      const float wide_mm = (open[i] - open[j]).norm();
      widest_mm = std::max(widest_mm, wide_mm);
      EXPECT_GT(wide_mm, 0);
      EXPECT_LE(wide_mm, 4.0001F);
      const auto half = body.verticesAt(organ.mesh.vertices_mm, 0.5F);
      EXPECT_NEAR((half[i] - half[j]).norm(), wide_mm / 2, 1e-4);
    }
    // Vertices are 1 mm apart or less: half of that off the middle, a lens of 12 mm is 0.7 % less.
    EXPECT_GT(widest_mm, 0.99F * 4);
  }
}

TEST(Incision, IsAsLongAndAsDeepAsItSays) {
  const TriangleMesh sphere = test::makeSphere(20, 60);
  const TissueBody body = cutTissue(sphere, cutOf(12, 4, 3, 30), viewFrom(20));
  float deepest_mm = 0;
  for (const float depth_mm : body.depth_mm) deepest_mm = std::max(deepest_mm, depth_mm);
  EXPECT_NEAR(deepest_mm, 3, 0.02);  // half a vertex off the middle
  // Along a great circle: the ends of 12 mm are 12 / 20 rad apart. They don't move, their
  // neighbours do, so they lie within one edge of the outermost lips.
  float span_mm = 0;
  const auto lips = lipsOf(body);
  for (const auto& [i, ignored] : lips)
    for (const auto& [j, ignored_too] : lips)
      span_mm = std::max(span_mm, (body.mesh.vertices_mm[i] - body.mesh.vertices_mm[j]).norm());
  const double chord_mm = 2 * 20 * std::sin(12.0 / 20 / 2);
  EXPECT_LT(span_mm, chord_mm);
  EXPECT_GT(span_mm, chord_mm - 2 * 1.0);  // edges of 1 mm at most
}

TEST(Incision, MovesTheSkinBesideItSmoothlyAndLeavesWhatIsFarAway) {
  const TriangleMesh sphere = test::makeSphere(20, 60);
  const TissueBody body = cutTissue(sphere, cutOf(12, 4, 3), viewFrom(20));
  double beside = 0;
  int count = 0;
  for (std::size_t i = 0; i < body.mesh.vertices_mm.size(); ++i) {
    if (body.depth_mm[i] > 0) continue;
    const Eigen::Vector3f& p = body.mesh.vertices_mm[i];
    EXPECT_LE(body.gape_mm[i].norm(), 2.0001F) << "nothing moves further than the lips";
    if ((p - Eigen::Vector3f(0, 0, 20)).norm() > 24) {  // two lengths of the cut
      EXPECT_LT(body.gape_mm[i].norm(), 0.1F);
    }
    // 1 mm off the lip's middle: (1 + r / 3.2) exp(-r / 3.2) is 0.96; a kink would give 0.73.
    if (std::abs(p.x()) < 1 && std::abs(std::abs(p.y()) - 1) < 0.3F && p.z() > 0) {
      beside += body.gape_mm[i].norm();
      EXPECT_GT(body.gape_mm[i].y() * p.y(), 0) << "away from the cut";
      ++count;
    }
  }
  ASSERT_GT(count, 4);
  EXPECT_GT(beside / count, 0.85 * 2);
  // No triangle of the skin turns over.
  const auto open = body.verticesAt(sphere.vertices_mm, 1);
  for (std::size_t t = 0; t < body.skin_triangles; ++t) {
    const auto normal = [&](const std::vector<Eigen::Vector3f>& at) -> Eigen::Vector3f {
      const Triangle& c = body.mesh.triangles[t];
      return (at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]);
    };
    EXPECT_GT(normal(open).dot(normal(body.mesh.vertices_mm)), 0);
  }
}

/// Mean difference in green along the line where the cut of 15 mm at 20 degrees lies at first.
double differenceAlongCut(const SimulatedFrame& with, const SimulatedFrame& without) {
  double sum = 0;
  int count = 0;
  for (double along_px = -20; along_px <= 20; along_px += 0.5)
    for (const double aside_px : {-1.0, 0.0, 1.0}) {
      // 140 px of focal length at 40 mm; the left camera stands 2.6 mm beside the middle.
      const double c = std::cos(20 * M_PI / 180), s = std::sin(20 * M_PI / 180);
      const int u = int(std::lround(79.5 + 9.1 + c * along_px - s * aside_px)),
                v = int(std::lround(59.5 + s * along_px + c * aside_px));
      sum += std::abs(with.pictures.left.at(u, v).green - without.pictures.left.at(u, v).green);
      ++count;
    }
  return sum / count;
}

TEST(Incision, IsNotToBeSeenUntilItOpens) {
  SimulationOptions options = smallIncision();  // that breathes, beats and is pushed
  options.texture.wetness = 0;  // bumps and highlights tell where texels lie, which differs
  options.light.relief = 0;
  Simulator whole(makeOrganMesh(options.organ, 1), options);
  options.cut = cutOf(15, 5, 4, 20);
  Simulator cut(makeOrganMesh(options.organ, 1), options);
  EXPECT_GT(cut.triangles().size(), whole.triangles().size());
  EXPECT_GT(differenceAlongCut(cut.frame(20), whole.frame(20)), 12) << "else it shows nothing";
  for (const int index : {0, 10}) {  // the cut starts to open at frame 10
    const SimulatedFrame with = cut.frame(index), without = whole.frame(index);
    for (std::size_t i = 0; i < with.depth_mm.size(); ++i) {
      const float a = with.depth_mm.values[i], b = without.depth_mm.values[i];
      ASSERT_EQ(std::isfinite(a), std::isfinite(b));
      // 2e-5 mm: rounding of split vertices, seen aslant; pixels on the silhouette may jump.
      if (std::isfinite(a) && std::abs(a - b) > 1e-3F) ADD_FAILURE() << a << " " << b;
      if (std::isfinite(a)) {
        EXPECT_LT((with.normals.values[i] - without.normals.values[i]).norm(), 1e-4);
      }
    }
    // A dark line a pixel wide would be 20 levels and more; texels lie elsewhere on split
    // triangles.
    EXPECT_LT(differenceAlongCut(with, without), 2);
  }
}

TEST(Incision, ShowsItsFloorAndMovesTheTracksOfItsLips) {
  SimulationOptions options = stillOptions();
  options.track_spacing_px = 4;
  options.cut = cutOf(16, 6, 3, 0);
  Simulator simulator(test::makeSphere(30, 60), options);
  const SimulatedFrame before = simulator.frame(0), after = simulator.frame(25);
  // The scope looks at the middle of the cut with the middle of its baseline.
  const Eigen::Vector2d middle_px = projectPoint(simulator.rig().left, Eigen::Vector3d(2.6, 0, 40));
  const int u = int(std::lround(middle_px.x())), v = int(std::lround(middle_px.y()));
  EXPECT_NEAR(after.depth_mm.at(u, v) - before.depth_mm.at(u, v), 3, 0.15);  // half a pixel aside
  const Rgb8 floor = after.pictures.left.at(u, v + 2), skin = before.pictures.left.at(u, v + 2);
  EXPECT_LT(floor.red, skin.red) << "darker";
  EXPECT_GT(int(floor.red) * skin.green, int(skin.red) * floor.green) << "redder";
  int up = 0, down = 0;
  for (std::size_t id = 0; id < simulator.trackPoints().size(); ++id) {
    const Eigen::Vector3d way_mm = after.tracks_world_mm[id] - before.tracks_world_mm[id];
    EXPECT_LE(way_mm.norm(), 3.001) << "half of the opening";
    EXPECT_TRUE(after.tracks_visible[id]) << "lips don't hide each other";
    const TrackPoint& point = simulator.trackPoints()[id];
    if (std::abs(point.u_px - u) > 4 || std::abs(point.v_px - v) > 12) continue;
    EXPECT_GT(way_mm.norm(), 0.85 * 3);  // 3 mm off the lip the skin keeps 0.9 of its way
    (point.v_px < v ? up : down) += (way_mm.y() < 0) == (point.v_px < v);
  }
  EXPECT_GT(up, 2);
  EXPECT_GT(down, 2);
}

TEST(Incision, FlowFollowsTheLips) {
  SimulationOptions options = stillOptions();
  options.cut = cutOf(16, 6, 3, 0);
  Simulator simulator(test::makeSphere(30, 60), options);
  const SimulatedFrame opening = simulator.frame(14, true), next = simulator.frame(15);
  double up = 0, down = 0;
  int missing = 0;
  for (int v = 0; v < opening.flow_px.height_px; ++v)
    for (int u = 60; u < 100; ++u) {
      const Eigen::Vector2f& flow = opening.flow_px.at(u, v);
      missing += !flow.allFinite();
      (v < 60 ? up : down) += flow.y() / (40 * 60);
    }
  EXPECT_EQ(missing, 0);
  EXPECT_LT(up, -0.02);
  EXPECT_GT(down, 0.02);
  for (const Eigen::Vector3f& normal : opening.normals.values)
    EXPECT_TRUE(normal.norm() == 0 || std::abs(normal.norm() - 1) < 1e-3);
}

TEST(Incision, GivesTheSameBytesOnAnyNumberOfThreads) {
  SimulationOptions options = smallIncision();
  options.cut = cutOf(15, 5, 4, 20);
  options.deformation.push_kind = "arap";
  const auto frameOn = [&](int threads) {
    const ThreadLimit limit(threads);
    return Simulator(makeOrganMesh(options.organ, 1), options).frame(18);
  };
  const SimulatedFrame one = frameOn(1), many = frameOn(0);
  EXPECT_EQ(one.pictures.left.values, many.pictures.left.values);
  EXPECT_EQ(one.vertices_world_mm, many.vertices_world_mm);
}

TEST(Incision, RefusesACutThatDoesNotFit) {
  const TriangleMesh sphere = test::makeSphere(20, 20);
  const auto message = [&](const CutOptions& cut) -> std::string {
    try {
      cutTissue(sphere, cut, viewFrom(20));
    } catch (const OptionError& error) {
      return error.what();
    }
    return "";
  };
  CutOptions off = cutOf(10, 3, 3);
  off.x_mm = 25;
  EXPECT_NE(message(off).find("misses the organ"), std::string::npos) << message(off);
  EXPECT_NE(message(cutOf(100, 3, 3)).find("turns away"), std::string::npos);
  EXPECT_NE(message(cutOf(10, 3, 40)).find("40 mm thick"), std::string::npos)
      << message(cutOf(10, 3, 40));
  CutOptions aside = cutOf(3, 1, 1);
  aside.x_mm = 19.8;  // where the surface runs along the view
  EXPECT_NE(message(aside).find("cut.angle_deg"), std::string::npos) << message(aside);
  const std::vector<std::function<void(CutOptions&)>> wrong{
      [](CutOptions& c) { c.length_mm = -1; },     [](CutOptions& c) { c.length_mm = 2; },
      [](CutOptions& c) { c.depth_mm = 0; },       [](CutOptions& c) { c.opening_mm = 8; },
      [](CutOptions& c) { c.opening_mm = -1; },    [](CutOptions& c) { c.start_s = -0.1; },
      [](CutOptions& c) { c.duration_s = 0; },     [](CutOptions& c) { c.angle_deg = 1000; },
      [](CutOptions& c) { c.x_mm = double(kNan); }};
  for (const auto& spoil : wrong) {
    CutOptions cut = cutOf(10, 3, 3);
    spoil(cut);
    EXPECT_NE(message(cut).find("cut."), std::string::npos) << message(cut);
  }
}

TEST(Incision, RefusesAnOpenSurfaceUnderTheBlade) {
  TriangleMesh sphere = test::makeSphere(20, 20);
  sphere.triangles.erase(std::remove_if(sphere.triangles.begin(), sphere.triangles.end(),
                                        [&](const Triangle& t) {
                                          const Eigen::Vector3f& p = sphere.vertices_mm[t[0]];
                                          return p.z() > 0 && std::abs(p.x() - 4) < 1.2F;
                                        }),
                         sphere.triangles.end());
  EXPECT_THROW(cutTissue(sphere, cutOf(12, 3, 3), viewFrom(20)), InputError);
}

TEST(Incision, WithoutLengthIsNone) {
  const TriangleMesh sphere = test::makeSphere(20, 10);
  const TissueBody body = cutTissue(sphere, {}, viewFrom(20));
  EXPECT_EQ(body.mesh.vertices_mm, sphere.vertices_mm);
  EXPECT_EQ(body.mesh.triangles, sphere.triangles);
  EXPECT_EQ(body.verticesAt(sphere.vertices_mm, 1), sphere.vertices_mm);
}

}  // namespace
}  // namespace softscope
