#include "features/match_consistency.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"
#include "features/kernels.h"
#include "features/match_formulas.h"

namespace softscope {
namespace {

/// Places of the matches by squares of the model image, so that those of neighbouring squares of a
/// row follow each other.
class MatchSquares {
 public:
  MatchSquares(const std::vector<PixelMatch>& matches, float side_px) : side_px_(side_px) {
    for (const PixelMatch& match : matches) {
      columns_ = std::max(columns_, column(match) + 1);
      rows_ = std::max(rows_, row(match) + 1);
    }
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const PixelMatch& match : matches) ++first_[at(column(match), row(match)) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    constexpr std::size_t kRegister = 8;  // is read beyond the last
    for (std::vector<float>* places : {&model_u_, &model_v_, &live_u_, &live_v_})
      places->assign(matches.size() + kRegister, 0);
    std::vector<std::size_t> next = first_;
    for (const PixelMatch& match : matches) {
      const std::size_t place = next[at(column(match), row(match))]++;
      model_u_[place] = match.model_px.x();
      model_v_[place] = match.model_px.y();
      live_u_[place] = match.live_px.x();
      live_v_[place] = match.live_px.y();
    }
  }

  /// Of a match, itself left out.
  NeighbourCounts countAround(const PixelMatch& match, const ConsistencyRules& rules) const {
    const float place[4] = {match.model_px.x(), match.model_px.y(), match.live_px.x(),
                            match.live_px.y()};
    NeighbourCounts all{-1, -1};
    const int left = std::max(column(match) - 1, 0),
              right = std::min(column(match) + 1, columns_ - 1);
    for (int r = std::max(row(match) - 1, 0); r <= std::min(row(match) + 1, rows_ - 1); ++r) {
      const std::size_t begin = first_[at(left, r)], end = first_[at(right, r) + 1];
      const NeighbourCounts counts = featureKernels().countNeighbours(
          {&model_u_[begin], &model_v_[begin], &live_u_[begin], &live_v_[begin]},
          static_cast<int>(end - begin), {&place[0], &place[1], &place[2], &place[3]}, rules);
      all.others += counts.others;
      all.agreeing += counts.agreeing;
    }
    return all;
  }

 private:
  int column(const PixelMatch& match) const {
    return static_cast<int>(match.model_px.x() / side_px_);
  }
  int row(const PixelMatch& match) const { return static_cast<int>(match.model_px.y() / side_px_); }
  std::size_t at(int c, int r) const { return static_cast<std::size_t>(r * columns_ + c); }

  float side_px_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::size_t> first_;  // of each square, and the end
  std::vector<float> model_u_, model_v_, live_u_, live_v_;
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
      const NeighbourCounts counts = squares.countAround(matches[i], rules);
      kept[i] = isConsistent(counts.agreeing, counts.others, rules);
    }
  });
  std::vector<PixelMatch> consistent;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (kept[i] != 0) consistent.push_back(matches[i]);
  return consistent;
}

}  // namespace softscope
