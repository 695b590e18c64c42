#include "calibrate/view_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

#include "core/error.h"

namespace softscope {
namespace {

std::string oneDigit(double value) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << value;
  return text.str();
}

/// Mean displacement of the common corners in the left image; infinite for too few.
double shiftPx(const BoardSighting& a, const BoardSighting& b) {
  std::map<int, Eigen::Vector2d> pixels;
  for (const BoardCorner& corner : a.left) pixels[corner.id] = corner.pixel;
  double sum = 0;
  int common = 0;
  for (const BoardCorner& corner : b.left) {
    const auto found = pixels.find(corner.id);
    if (found == pixels.end()) continue;
    sum += (found->second - corner.pixel).norm();
    ++common;
  }
  return common < 4 ? std::numeric_limits<double>::infinity() : sum / common;
}

/// First quartile of the edge widths.
double sharpWidth(const std::vector<BoardSighting>& sightings) {
  std::vector<double> widths;
  for (const BoardSighting& sighting : sightings) widths.push_back(sighting.edge_width_px);
  std::sort(widths.begin(), widths.end());
  return widths[widths.size() / 4];
}

}  // namespace

void ViewChoiceOptions::validate() const {
  require(blur_ratio > 1, "blur_ratio", blur_ratio, "must be above 1");
  require(least_shift_px >= 0, "least_shift_px", least_shift_px, "can't be negative");
  require(most_views >= 3, "most_views", most_views, "must be 3 or more");
}

ViewChoice chooseViews(const std::vector<BoardSighting>& sightings,
                       const ViewChoiceOptions& options) {
  options.validate();
  ViewChoice choice;
  if (sightings.empty()) return choice;
  const double sharp_px = sharpWidth(sightings);
  std::vector<std::size_t> by_sharpness(sightings.size());
  std::iota(by_sharpness.begin(), by_sharpness.end(), std::size_t{0});
  std::stable_sort(by_sharpness.begin(), by_sharpness.end(), [&](std::size_t a, std::size_t b) {
    return sightings[a].edge_width_px < sightings[b].edge_width_px;
  });
  for (const std::size_t i : by_sharpness) {
    const BoardSighting& one = sightings[i];
    if (one.edge_width_px > options.blur_ratio * sharp_px) {
      choice.left_out.push_back({one.frame, "blurred: edges of " + oneDigit(one.edge_width_px) +
                                                " px, sharp ones of " + oneDigit(sharp_px) +
                                                " px"});
      continue;
    }
    const auto twin = std::find_if(choice.used.begin(), choice.used.end(), [&](std::size_t used) {
      return shiftPx(sightings[used], one) < options.least_shift_px;
    });
    if (twin != choice.used.end())
      choice.left_out.push_back({one.frame, "doubled: the board lies as in frame " +
                                                std::to_string(sightings[*twin].frame) +
                                                ", which is sharper"});
    else
      choice.used.push_back(i);
  }
  // Farthest point sampling: each next view has the largest distance to all selected ones.
  if (choice.used.size() > static_cast<std::size_t>(options.most_views)) {
    std::vector<std::size_t> kept{choice.used.front()},
        rest(choice.used.begin() + 1, choice.used.end());
    std::vector<double> nearest(rest.size(), std::numeric_limits<double>::infinity());
    while (kept.size() < static_cast<std::size_t>(options.most_views)) {
      for (std::size_t k = 0; k < rest.size(); ++k)
        nearest[k] = std::min(nearest[k], shiftPx(sightings[kept.back()], sightings[rest[k]]));
      const auto farthest = std::max_element(nearest.begin(), nearest.end()) - nearest.begin();
      kept.push_back(rest[static_cast<std::size_t>(farthest)]);
      rest.erase(rest.begin() + farthest);
      nearest.erase(nearest.begin() + farthest);
    }
    for (const std::size_t i : rest)
      choice.left_out.push_back({sightings[i].frame, "not needed: there are enough views"});
    choice.used = kept;
  }
  std::sort(choice.used.begin(), choice.used.end());
  std::sort(choice.left_out.begin(), choice.left_out.end(),
            [](const LeftOutView& a, const LeftOutView& b) { return a.frame < b.frame; });
  return choice;
}

}  // namespace softscope
