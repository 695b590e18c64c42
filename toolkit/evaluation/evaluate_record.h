// toolkit/evaluation/evaluate_record.h: record of an evaluation as JSON and as text.
#pragma once

#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Content of evaluation.json, without frames and thresholds. Contains
/// every metric of this kind of evaluation, null without a measurement:
/// the record of an empty result lists the names allowed in --fail-if.
FactSheet::Json evaluationJson(const EvaluationResult& result);

FactSheet evaluationFacts(const EvaluationResult& result);

}  // namespace softscope
