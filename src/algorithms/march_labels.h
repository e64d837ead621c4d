#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/march_heap.h"

// The state of a march. A label is the distance of a vertex from one source.

namespace tufted {

/// A source goes on from a vertex only if it is farther than the nearest source by at most this many times the longest
/// edge there. Each edge more reduces the error to a fifteenth.
constexpr double march_reach = 4;

/// The labels of a single source. Vertex and label have the same number.
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

  void takeNearest(std::vector<double>& distance, std::vector<int>& /*source*/) { distance = std::move(distance_); }

 private:
  int source_;
  std::vector<double> distance_;  ///< by label
  std::vector<std::uint8_t> frozen_;
};

/// The labels of several sources: at each vertex, one for each source that is nearest or nearly so there. Each source
/// marches independently of the others, but only where it may be the nearest.
class LabelsOfSeveralSources {
 public:
  /// @param sources their numbers lie in [0, sources)
  LabelsOfSeveralSources(std::size_t vertices, int sources)
      : vertices_(vertices),
        labels_((vertices + block - 1) / block * block),
        free_(static_cast<std::size_t>(sources)) {}

  std::size_t size() const { return labels_.size(); }
  int vertexOf(int label) const { return labels_[label].vertex; }
  int sourceOf(int label) const { return labels_[label].source; }
  double distance(int label) const { return labels_[label].distance; }
  void setDistance(int label, double distance) { labels_[label].distance = distance; }
  bool isFrozen(int label) const { return labels_[label].is_frozen; }

  /// The label of a source at a vertex; -1 if there is none.
  int knownLabelAt(int vertex, int source) const {
    int label = vertex;
    while (label >= 0 && labels_[label].source != source) label = labels_[label].next;
    return label;
  }
  /// The label of a source at a vertex, made if there is none.
  int labelAt(int vertex, int source, MarchHeap& heap) {
    const int known = knownLabelAt(vertex, source);
    if (known >= 0) return known;
    int label = vertex;
    if (labels_[vertex].source >= 0) {
      label = freeLabel(source, heap);
      labels_[label].next = labels_[vertex].next;
      labels_[vertex].next = label;
    }
    labels_[label].vertex = vertex;
    labels_[label].source = source;
    return label;
  }

  void freeze(int label) {
    labels_[label].goes_on = isNear(label);
    labels_[label].is_frozen = true;
  }

  /// Whether the source of a frozen label goes on from its vertex.
  bool goesOn(int label) const { return labels_[label].goes_on; }
  /// Whether a distance through a triangle requires that the source sees the vertex. False for labels from which their
  /// source does not go on; the plane of the triangle is extended for them.
  bool mustSee(int label) const { return isNear(label); }
  bool mayBe(int label, double distance) const { return distance > nearest(labels_[label].vertex); }

  /// Sets the longest edge at the vertex of a frozen label.
  void setReach(int label, double longest_edge) { labels_[labels_[label].vertex].longest_edge = longest_edge; }

  /// Returns the nearest source of each vertex and its distance; of equally near ones the first.
  void takeNearest(std::vector<double>& distance, std::vector<int>& source) const {
    distance.resize(vertices_);
    source.resize(vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      const Label* first = &labels_[v];
      for (int other = first->next; other >= 0; other = labels_[other].next) {
        const Label& label = labels_[other];
        if (std::pair(label.distance, label.source) < std::pair(first->distance, first->source)) first = &label;
      }
      distance[v] = first->distance;
      source[v] = first->distance < std::numeric_limits<double>::infinity() ? first->source : -1;
    }
  }

 private:
  /// The first label of a vertex has the vertex's number and holds its `longest_edge`.
  struct Label {
    double distance = std::numeric_limits<double>::infinity();
    double longest_edge = std::numeric_limits<double>::infinity();
    int vertex = -1;
    int source = -1;  ///< -1: not in use
    int next = -1;    ///< next label of the same vertex; -1: none
    bool is_frozen = false, goes_on = true;
  };

  /// A source does not go on where this many others are nearer. On grids, squares and tori, with 3, 2 of 213,600
  /// distances differ by up to 3e-6 from the least of single marches; with 5 none differs by 1e-9.
  static constexpr int most_nearer = 5;
  /// Labels of one source per block of memory, for the cache.
  static constexpr int block = 8;

  /// The least distance among the frozen labels of a vertex, infinite if it has none.
  double nearest(int vertex) const {
    double least = std::numeric_limits<double>::infinity();
    for (int label = vertex; label >= 0; label = labels_[label].next)
      if (labels_[label].is_frozen) least = std::min(least, labels_[label].distance);
    return least;
  }

  bool isNear(int label) const {
    const Label& own = labels_[label];
    if (label == own.vertex && own.next < 0) return true;
    double least = own.distance;
    int nearer = 0;
    for (int other = own.vertex; other >= 0; other = labels_[other].next) {
      if (!labels_[other].is_frozen || !(labels_[other].distance < own.distance)) continue;
      least = std::min(least, labels_[other].distance);
      ++nearer;
    }
    return nearer == 0 ||
           (nearer < most_nearer && own.distance <= least + march_reach * labels_[own.vertex].longest_edge);
  }

  int freeLabel(int source, MarchHeap& heap) {
    int& free = free_[source];
    if (free % block == 0) {
      free = static_cast<int>(labels_.size());
      labels_.resize(labels_.size() + block);
      heap.grow(block);
    }
    return free++;
  }

  std::size_t vertices_;
  std::vector<Label> labels_;  ///< one for each vertex, then others in blocks
  std::vector<int> free_;      ///< next unused label of each source; a multiple of `block`: a new block is needed
};

}  // namespace tufted
