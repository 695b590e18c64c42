#include "features/match_consistency.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "features/match_formulas.h"

namespace softscope {
namespace {

/// Indices of the matches in squares of the model image.
class MatchSquares {
 public:
  MatchSquares(const std::vector<PixelMatch>& matches, float side_px) : side_px_(side_px) {
    for (const PixelMatch& match : matches) {
      columns_ = std::max(columns_, column(match) + 1);
      rows_ = std::max(rows_, row(match) + 1);
    }
    members_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < matches.size(); ++i)
      members_[at(column(matches[i]), row(matches[i]))].push_back(i);
  }

  /// Calls visit(i) for every match in the nine surrounding squares.
  template <class Visit>
  void around(const PixelMatch& match, const Visit& visit) const {
    for (int r = std::max(row(match) - 1, 0); r <= std::min(row(match) + 1, rows_ - 1); ++r)
      for (int c = std::max(column(match) - 1, 0); c <= std::min(column(match) + 1, columns_ - 1);
           ++c)
        for (const std::size_t i : members_[at(c, r)]) visit(i);
  }

 private:
  int column(const PixelMatch& match) const {
    return static_cast<int>(match.model_px.x() / side_px_);
  }
  int row(const PixelMatch& match) const { return static_cast<int>(match.model_px.y() / side_px_); }
  std::size_t at(int c, int r) const { return static_cast<std::size_t>(r * columns_ + c); }

  float side_px_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::size_t>> members_;
};

}  // namespace

std::vector<PixelMatch> keepConsistent(const std::vector<PixelMatch>& matches,
                                       const ConsistencyOptions& options) {
  if (options.kMinShare <= 0) return matches;
  const ConsistencyRules rules = consistencyRules(options);
  const MatchSquares squares(matches, static_cast<float>(options.kReachPx));
  std::vector<std::uint8_t> kept(matches.size(), 0);
  parallelRanges(static_cast<int>(matches.size()), 256, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      int others = 0, agreeing = 0;
      squares.around(matches[i], [&](std::size_t k) {
        const Eigen::Vector2f apart = matches[k].model_px - matches[i].model_px;
        if (k == i || !areNeighbours(apart.x(), apart.y(), rules)) return;
        ++others;
        const Eigen::Vector2f live_apart = matches[k].live_px - matches[i].live_px;
        agreeing += moveAlike(apart.x(), apart.y(), live_apart.x(), live_apart.y(), rules);
      });
      kept[i] = isConsistent(agreeing, others, rules);
    }
  });
  std::vector<PixelMatch> consistent;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (kept[i] != 0) consistent.push_back(matches[i]);
  return consistent;
}

}  // namespace softscope
