// tests/toolkit/metric_lists_test.cpp: readers of records ask for what writers write.
#include "toolkit/record/metric_lists.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "toolkit/comparison/compare_record.h"
#include "toolkit/evaluation/evaluate_frames.h"
#include "toolkit/evaluation/evaluate_record.h"
#include "toolkit/evaluation/truthless_result.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/report/report_cohort.h"
#include "toolkit/study/study_table.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

bool has(const Json& record, std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return record.contains(Json::json_pointer("/" + path));
}

TEST(MetricLists, EveryNumberOfACohortIsInTheRecords) {
  const Json run = evaluationJson({}), pair = comparisonJson({});
  for (const CohortMetric& metric : cohortMetrics()) {
    EXPECT_TRUE(has(run, metric.of_run)) << metric.of_run;
    EXPECT_TRUE(*metric.of_pair == '\0' || has(pair, metric.of_pair)) << metric.of_pair;
  }
}

TEST(MetricLists, EveryUsualColumnOfAStudyIsInTheRecords) {
  const Json run = evaluationJson({});
  const std::string part = "evaluation.";
  for (const StudyMetric& column : usualColumns()) {
    if (column.path.compare(0, part.size(), part) != 0) continue;  // of case.json itself
    EXPECT_TRUE(has(run, column.path.substr(part.size()))) << column.path;
  }
}

TEST(MetricLists, RecordsAndTablesHaveEveryNumber) {
  const Json run = evaluationJson({}), pictures = truthlessJson({});
  const std::vector<std::string> columns = frameTable({}).headings;
  for (const Metric<Statistics>& m : statisticsMetrics())
    EXPECT_THAT(columns, testing::Contains(m.key + std::string("_mm")));
  for (const Metric<HausdorffDistances>& m : hausdorffMetrics()) {
    EXPECT_TRUE(has(run, std::string("surface.hausdorff.") + m.key));
    EXPECT_THAT(columns, testing::Contains(m.key));
  }
  for (const Metric<PictureErrors>& m : drawnViewMetrics()) {
    EXPECT_TRUE(has(run, std::string("view.") + m.key));
    EXPECT_TRUE(has(pictures, std::string("view.") + m.key));
    EXPECT_THAT(columns, testing::Contains("view_" + std::string(m.key)));
  }
}

TEST(MetricLists, ANumberStandsUnderItsKey) {
  Statistics s;
  s.count = 9;
  s.mean = 1;
  s.sd = 2;
  s.rmse = 3;
  s.median = 4;
  s.p95 = 5;
  s.max = 6;
  EXPECT_EQ(statisticsJson(s, "_mm").dump(),
            R"({"mean_mm":1.0,"sd_mm":2.0,"rmse_mm":3.0,"median_mm":4.0,"p95_mm":5.0,)"
            R"("max_mm":6.0,"n":9})");
  HausdorffDistances distances;
  distances.hd95_pooled_mm = 7;
  distances.masd_mm = 8;
  const Json json = metricsJson(hausdorffMetrics(), distances);
  EXPECT_EQ(json["hd95_pooled_mm"], 7);
  EXPECT_EQ(json["masd_mm"], 8);
}

}  // namespace
}  // namespace softscope
