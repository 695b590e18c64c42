// toolkit/report/report_alignment.cpp: description of the transform, errors before and after it.
#include "toolkit/report/report_alignment.h"

#include <Eigen/Geometry>
#include <cmath>

#include "eval/statistics/cohort.h"
#include "toolkit/report/report_words.h"

namespace softscope {
namespace {

using Kind = ReportCase::Kind;

/// Transform of the model, if the record contains one.
std::string motionText(const ReportCase& c) {
  const auto pointer = FactSheet::Json::json_pointer(
      c.kind == Kind::kPair ? "/alignment/reference_from_test"
                            : "/comparison/alignments/0/mesh_from_run");
  if (!c.record.contains(pointer)) return {};
  const FactSheet::Json& rows = c.record.at(pointer);
  Eigen::Matrix4d matrix;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      if (!rows.is_array() || rows.size() != 4 || !rows[i].is_array() || rows[i].size() != 4 ||
          !rows[i][j].is_number())
        return {};
      matrix(int(i), int(j)) = rows[i][j].get<double>();
    }
  const double angle_rad = Eigen::AngleAxisd(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).angle();
  const std::string turn = "turned by " + fixed(angle_rad * 180 / M_PI, 2) + " degrees";
  if (c.maps.empty()) return turn;
  // Rotation about the centre of the model: about the origin it would include a translation.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : c.maps.front().surface.vertices_mm) middle += p.cast<double>();
  middle /= double(c.maps.front().surface.vertices_mm.size());
  const Eigen::Vector3d before = matrix.inverse().topRows<3>() * middle.homogeneous();
  return turn + ", and its middle shifted by " + millimetresText((middle - before).norm());
}

/// Estimated target registration error; empty if unknown.
std::string targetErrorText(const ReportCase& c) {
  const auto value = [&](const char* key) {
    return numberAt(c.record, std::string("alignment.tre_leave_one_out.") + key);
  };
  const double n = value("n"), mean_mm = value("mean_mm"), sd_mm = value("sd_mm");
  if (!(n >= 2 && n < 1e9) || !std::isfinite(mean_mm) || !std::isfinite(sd_mm)) return {};
  Statistics tre_mm;
  tre_mm.count = static_cast<std::size_t>(n);
  tre_mm.mean = mean_mm;
  tre_mm.sd = sd_mm;
  return "At a position that was not used for the alignment the error is " +
         millimetresText(mean_mm) + " on average (TRE over " + std::to_string(std::llround(n)) +
         " landmarks, 95 % confidence " + intervalText(meanInterval(tre_mm)) +
         " mm, by Student's t).";
}

}  // namespace

bool wasAligned(const ReportCase& c) {
  const std::string how = c.alignment();
  return !how.empty() && how != "none";
}

std::string alignmentText(const ReportCase& c) {
  if (!c.hasTruth()) return "none: there is no reference";
  if (!wasAligned(c)) return "none: no error is removed by an alignment to the reference";
  const std::string how = c.alignment();
  if (how == "rigid") return "rigid: one transform, from the first model, for all models";
  if (how == "icp")
    return "ICP: the model was aligned to the reference by closest points; errors due to a rigid "
           "motion are not included below";
  if (how == "landmarks") return "landmarks: aligned by pairs of landmarks";
  if (how == "landmarks, then icp")
    return "landmarks, then ICP: aligned by pairs of landmarks, then by closest points; errors due "
           "to a rigid motion are not included below";
  return how;
}

std::vector<ReportPart> alignmentParts(const ReportCase& c) {
  std::vector<ReportPart> parts;
  if (!wasAligned(c)) return parts;
  if (const std::string motion = motionText(c); !motion.empty())
    parts.emplace_back(ReportParagraph{"The model was " + motion + "."});
  std::vector<NamedPart> rows;
  if (c.kind == Kind::kPair) {
    rows = {{"before the alignment", "alignment.before"},
            {"after it", "accuracy"},
            {"landmarks: FRE, residual of the fit", "alignment.fre"},
            {"landmarks: TRE, each left out in turn", "alignment.tre_leave_one_out"}};
    addTable(statisticsTable("Distances [mm]", c.record, rows), parts);
    if (const std::string tre = targetErrorText(c); !tre.empty())
      parts.emplace_back(ReportParagraph{tre});
  } else if (c.record.contains(FactSheet::Json::json_pointer("/comparison/alignments/0"))) {
    const auto& first = c.record["comparison"]["alignments"][0];
    addTable(statisticsTable("Distances of the first model [mm]", first,
                             {{"before the alignment", "before"}, {"after it", "after"}}),
             parts);
  }
  return parts;
}

}  // namespace softscope
