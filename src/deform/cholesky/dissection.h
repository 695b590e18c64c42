// src/deform/cholesky/dissection.h: elimination by nested dissection: few levels of wide fronts.
#pragma once

#include "deform/cholesky/block_pattern.h"
#include "deform/cholesky/elimination_tree.h"

namespace softscope {

/// Halves the nodes until at most `most_pivots` are left; one front per
/// rest, and per separator a chain of fronts with at most `most_pivots`
/// pivots each. Fronts of one level are independent, as a GPU requires;
/// fillReducingOrder() has fewer operations. Depends on the pattern only.
EliminationTree dissect(const BlockPattern& pattern, int most_pivots);

}  // namespace softscope
