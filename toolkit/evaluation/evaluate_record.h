// toolkit/evaluation/evaluate_record.h: an evaluation as JSON and as lines for people.
#pragma once

#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// What evaluation.json holds, without frames and thresholds. Every metric that this kind of
/// evaluation can have is there, null where it wasn't measured: so the record of an empty result
/// tells which names --fail-if may use.
FactSheet::Json evaluationJson(const EvaluationResult& result);

FactSheet evaluationFacts(const EvaluationResult& result);

}  // namespace softscope
