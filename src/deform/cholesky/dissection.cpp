#include "deform/cholesky/dissection.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace softscope {
namespace {

using Nodes = std::vector<int>;

class Dissector {
 public:
  Dissector(const BlockPattern& pattern, int most_pivots)
      : most_pivots_(static_cast<std::size_t>(most_pivots)),
        neighbours_(static_cast<std::size_t>(pattern.nodes())),
        set_of_(neighbours_.size(), 0),
        distance_(neighbours_.size(), -1),
        eliminated_(neighbours_.size(), 0) {
    for (int j = 0; j < pattern.nodes(); ++j)
      for (int b = pattern.column_start[j] + 1; b < pattern.column_start[j + 1]; ++b) {
        neighbours_[j].push_back(pattern.row[b]);
        neighbours_[pattern.row[b]].push_back(j);
      }
  }

  EliminationTree run() {
    Nodes all(neighbours_.size());
    std::iota(all.begin(), all.end(), 0);
    tree_.roots = eliminate(std::move(all));
    finish();
    return std::move(tree_);
  }

 private:
  /// Returns the fronts of `set` without a parent.
  Nodes eliminate(Nodes set) {
    if (set.empty()) return {};
    const int mark = ++last_set_;
    for (const int j : set) set_of_[j] = mark;
    Nodes reached = breadthFirst(set.front());
    if (reached.size() < set.size()) return eliminateApart(set, reached);
    if (set.size() <= most_pivots_) return {addFront(set, {})};
    auto [low, high] = halves(set);
    Nodes low_rim = rim(low, high), high_rim = rim(high, low);
    const bool takes_low = low_rim.size() < high_rim.size();
    Nodes& separator = takes_low ? low_rim : high_rim;
    remove(separator, takes_low ? &low : &high);
    Nodes children = eliminate(std::move(low));
    for (const int front : eliminate(std::move(high))) children.push_back(front);
    return {addChain(separator, std::move(children))};
  }

  int addChain(const Nodes& separator, Nodes children) {
    int last = 0;
    for (std::size_t begin = 0; begin < separator.size(); begin += most_pivots_) {
      const std::size_t end = std::min(begin + most_pivots_, separator.size());
      last = addFront({separator.begin() + static_cast<std::ptrdiff_t>(begin),
                       separator.begin() + static_cast<std::ptrdiff_t>(end)},
                      std::move(children));
      children = {last};
    }
    return last;
  }

  Nodes eliminateApart(const Nodes& set, Nodes connected) {
    Nodes rest = set;
    std::sort(connected.begin(), connected.end());
    remove(connected, &rest);
    Nodes fronts = eliminate(std::move(connected));
    for (const int front : eliminate(std::move(rest))) fronts.push_back(front);
    return fronts;
  }

  /// Nodes of the set of the start in the order of their distance; sets distance_.
  Nodes breadthFirst(int start) {
    for (std::size_t j = 0; j < distance_.size(); ++j) distance_[j] = -1;
    Nodes queue{start};
    distance_[start] = 0;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const int k : neighbours_[queue[i]])
        if (set_of_[k] == set_of_[start] && distance_[k] < 0) {
          distance_[k] = distance_[queue[i]] + 1;
          queue.push_back(k);
        }
    return queue;
  }

  /// By the difference of distances to two nodes far apart.
  std::pair<Nodes, Nodes> halves(const Nodes& set) {
    const int first = breadthFirst(breadthFirst(set.front()).back()).back();
    const int second = breadthFirst(first).back();
    Nodes key = distance_;
    breadthFirst(second);
    for (std::size_t j = 0; j < key.size(); ++j) key[j] -= distance_[j];
    Nodes sorted = set;
    std::sort(sorted.begin(), sorted.end(),
              [&](int a, int b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::pair<Nodes, Nodes> both{{sorted.begin(), middle}, {middle, sorted.end()}};
    std::sort(both.first.begin(), both.first.end());
    std::sort(both.second.begin(), both.second.end());
    return both;
  }

  /// Nodes of `set` adjacent to `other`.
  Nodes rim(const Nodes& set, const Nodes& other) {
    const int mark = ++last_set_;
    for (const int j : other) set_of_[j] = mark;
    Nodes found;
    for (const int j : set)
      if (std::any_of(neighbours_[j].begin(), neighbours_[j].end(),
                      [&](int k) { return set_of_[k] == mark; }))
        found.push_back(j);
    return found;
  }

  static void remove(const Nodes& taken, Nodes* set) {
    Nodes left;
    std::set_difference(set->begin(), set->end(), taken.begin(), taken.end(),
                        std::back_inserter(left));
    *set = std::move(left);
  }

  /// The border contains nodes until finish().
  int addFront(const Nodes& pivots, Nodes children) {
    Supernode front;
    front.first = static_cast<int>(tree_.order.size());
    front.columns = static_cast<int>(pivots.size());
    for (const int j : pivots) eliminated_[j] = 1;
    for (const int child : children)
      for (const int j : tree_.supernodes[child].rows) front.rows.push_back(j);
    for (const int j : pivots)
      for (const int k : neighbours_[j]) front.rows.push_back(k);
    std::sort(front.rows.begin(), front.rows.end());
    front.rows.erase(std::unique(front.rows.begin(), front.rows.end()), front.rows.end());
    front.rows.erase(std::remove_if(front.rows.begin(), front.rows.end(),
                                    [&](int j) { return eliminated_[j] != 0; }),
                     front.rows.end());
    const int number = static_cast<int>(tree_.supernodes.size());
    for (const int child : children) tree_.supernodes[child].parent = number;
    tree_.order.insert(tree_.order.end(), pivots.begin(), pivots.end());
    tree_.supernode_of.insert(tree_.supernode_of.end(), pivots.size(), number);
    front.children = std::move(children);
    tree_.supernodes.push_back(std::move(front));
    return number;
  }

  void finish() {
    tree_.position.resize(tree_.order.size());
    for (std::size_t k = 0; k < tree_.order.size(); ++k)
      tree_.position[tree_.order[k]] = static_cast<int>(k);
    for (Supernode& front : tree_.supernodes) {
      for (int& row : front.rows) row = tree_.position[row];
      std::sort(front.rows.begin(), front.rows.end());
      for (int c = 0; c < front.columns; ++c) {
        const double left = front.columns - c + static_cast<double>(front.rows.size());
        front.operations += left * left / 2;
      }
      for (const int child : front.children) front.operations += tree_.supernodes[child].operations;
    }
  }

  std::size_t most_pivots_;
  std::vector<Nodes> neighbours_;
  Nodes set_of_, distance_;
  std::vector<char> eliminated_;
  int last_set_ = 0;
  EliminationTree tree_;
};

}  // namespace

EliminationTree dissect(const BlockPattern& pattern, int most_pivots) {
  return Dissector(pattern, most_pivots).run();
}

}  // namespace softscope
