#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "algorithms/march_heap.h"

// What a march knows of the vertices. A label is the distance of a vertex from one source.

namespace tufted {

/// One label for each vertex, with the number of the vertex: all distances are from one source.
class LabelsOfOneSource {
 public:
  LabelsOfOneSource(std::size_t vertices, int source)
      : source_(source), distance_(vertices, std::numeric_limits<double>::infinity()), frozen_(vertices, 0) {}

  std::size_t size() const { return distance_.size(); }
  static int vertexOf(int label) { return label; }
  static int labelAt(int vertex, int /*source*/, MarchHeap& /*heap*/) { return vertex; }
  static int knownLabelAt(int vertex, int /*source*/) { return vertex; }
  int sourceOf(int /*label*/) const { return source_; }
  double distance(int label) const { return distance_[label]; }
  void setDistance(int label, double distance) { distance_[label] = distance; }
  bool isFrozen(int label) const { return frozen_[label] != 0; }
  void freeze(int label) { frozen_[label] = 1; }
  static bool goesOn(int /*label*/) { return true; }
  static bool mustSee(int /*label*/) { return true; }
  static bool mayBe(int /*label*/, double /*distance*/) { return true; }
  static void setReach(int /*label*/, double /*longest_edge*/) {}

  void takeNearest(std::vector<double>& distance, std::vector<int>& source) {
    source.assign(distance_.size(), -1);
    for (std::size_t v = 0; v < distance_.size(); ++v)
      if (distance_[v] < std::numeric_limits<double>::infinity()) source[v] = source_;
    distance = std::move(distance_);
  }

 private:
  int source_;
  std::vector<double> distance_;  ///< of each label
  std::vector<std::uint8_t> frozen_;
};

/// A label for each source that may be the nearest one at a vertex or close to it. Each source marches by itself, so
/// that distances are those of a march from it alone, and goes no farther than that.
class LabelsOfSeveralSources {
 public:
  explicit LabelsOfSeveralSources(std::size_t vertices) : vertices_(vertices) { labels_.reserve(vertices); }

  std::size_t size() const { return labels_.size(); }
  int vertexOf(int label) const { return labels_[label].vertex; }
  int sourceOf(int label) const { return labels_[label].source; }
  double distance(int label) const { return labels_[label].distance; }
  void setDistance(int label, double distance) { labels_[label].distance = distance; }
  bool isFrozen(int label) const { return labels_[label].is_frozen; }

  /// @returns -1 if there is none
  int knownLabelAt(int vertex, int source) const {
    int label = vertices_[vertex].label;
    while (label >= 0 && labels_[label].source != source) label = labels_[label].next;
    return label;
  }
  /// Makes one if there is none.
  int labelAt(int vertex, int source, MarchHeap& heap) {
    const int known = knownLabelAt(vertex, source);
    if (known >= 0) return known;
    const int label = freeLabel(source, heap);
    labels_[label] = {std::numeric_limits<double>::infinity(), vertex, source, vertices_[vertex].label, false, true};
    vertices_[vertex].label = label;
    ++vertices_[vertex].labels;
    return label;
  }

  void freeze(int label) {
    labels_[label].goes_on = isNear(label);
    labels_[label].is_frozen = true;
    Vertex& vertex = vertices_[labels_[label].vertex];
    vertex.nearest = std::min(vertex.nearest, labels_[label].distance);
  }

  /// Whether the source of a frozen label marches on from there.
  bool goesOn(int label) const { return labels_[label].goes_on; }
  /// Labels from which their source does not go on stand for its front beside where it does: the plane of a triangle
  /// extended, whether or not the source sees the vertex through it.
  bool mustSee(int label) const { return isNear(label); }
  bool mayBe(int label, double distance) const { return distance > vertices_[labels_[label].vertex].nearest; }

  /// Says how long the edges at the vertex of a frozen label are.
  void setReach(int label, double longest_edge) {
    Vertex& vertex = vertices_[labels_[label].vertex];
    vertex.limit = std::min(vertex.limit, vertex.nearest + reach * longest_edge);
  }

  /// The nearest source of each vertex, of equally near ones the first.
  void takeNearest(std::vector<double>& distance, std::vector<int>& source) const {
    distance.assign(vertices_.size(), std::numeric_limits<double>::infinity());
    source.assign(vertices_.size(), -1);
    for (const Label& label : labels_) {
      if (label.vertex < 0) continue;
      double& least = distance[label.vertex];
      int& nearest = source[label.vertex];
      if (label.distance > least || (label.distance == least && nearest >= 0 && nearest < label.source)) continue;
      least = label.distance;
      nearest = label.source;
    }
  }

 private:
  struct Label {
    double distance = std::numeric_limits<double>::infinity();
    int vertex = -1;  ///< -1: not in use
    int source = -1;
    int next = -1;  ///< label of the same vertex; -1: none
    bool is_frozen = false, goes_on = true;
  };
  struct Vertex {
    double nearest = std::numeric_limits<double>::infinity();  ///< of its frozen labels
    double limit = std::numeric_limits<double>::infinity();    ///< sources beyond it do not go on
    int label = -1;                                            ///< one of its labels
    int labels = 0;                                            ///< how many it has
  };

  /// Sources farther than the nearest one by this many times the longest edge there do not go on. What is left out
  /// changes distances by a part that falls to a fifteenth with each edge; see docs/algorithm.md.
  static constexpr double reach = 4;
  /// Nor those that are farther than so many others, as where sources lie side by side.
  static constexpr int most_nearer = 5;

  bool isNear(int label) const {
    const Label& own = labels_[label];
    const Vertex& vertex = vertices_[own.vertex];
    if (!(vertex.nearest < own.distance)) return true;
    if (own.distance > vertex.limit) return false;
    if (vertex.labels <= most_nearer) return true;
    int nearer = 0;
    for (int other = vertex.label; other >= 0; other = labels_[other].next)
      nearer += static_cast<int>(labels_[other].is_frozen && labels_[other].distance < own.distance);
    return nearer < most_nearer;
  }

  /// Labels of a source that one comes to after another lie side by side, or most would not be in the cache.
  static constexpr int block = 8;

  int freeLabel(int source, MarchHeap& heap) {
    if (source >= std::ssize(free_)) free_.resize(static_cast<std::size_t>(source) + 1, 0);
    int& free = free_[source];
    if (free % block == 0) {
      free = static_cast<int>(labels_.size());
      labels_.resize(labels_.size() + block);
      heap.grow(block);
    }
    return free++;
  }

  std::vector<Vertex> vertices_;
  std::vector<Label> labels_;  ///< in blocks
  std::vector<int> free_;      ///< the next label of each source; a multiple of `block`: in a block to be made
};

}  // namespace tufted
