#include "base/workspace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <mutex>
#include <new>
#include <utility>

namespace tufted {
namespace {

constexpr int steps = 4;  // classes of sizes per power of two
constexpr int least_exponent = 6;
constexpr int classes = steps * (48 - least_exponent);

thread_local Workspace* current_workspace = nullptr;

/// The bytes that blocks of a class hold; in the least class 2^least_exponent.
std::size_t sizeOf(int size_class) {
  const int exponent = least_exponent + size_class / steps;
  return (std::size_t{1} << exponent) / steps * static_cast<std::size_t>(steps + size_class % steps);
}

/// The least class whose blocks hold so many bytes.
int classOf(std::size_t bytes) {
  if (bytes <= sizeOf(0)) return 0;
  const int exponent = std::bit_width(bytes - 1) - 1;
  const std::size_t step = (std::size_t{1} << exponent) / steps;
  const auto above = static_cast<int>((bytes - (std::size_t{1} << exponent) + step - 1) / step);
  return steps * (exponent - least_exponent) + above;
}

using Owner = Workspace::Store*;

/// Stands in front of every block of a workspace. Blocks of the heap have a null owner alone in front: with one word in
/// front malloc gives an array of n numbers the room that it gives Eigen's, so that each fits where the other was.
struct Header {
  std::int64_t size_class;
  Owner owner;
};

}  // namespace

/// Lists of blocks that wait, by class. Lives as long as the workspace or any block of it.
class Workspace::Store {
 public:
  Header* take(std::size_t bytes) {
    const int size_class = classOf(bytes);
    const std::lock_guard lock(mutex_);
    if (Waiting* const block = waiting_[size_class]; block != nullptr) {
      waiting_[size_class] = block->next;
      use(size_class);
      return &block->header;
    }
    auto* const header = new (fromHeap(sizeof(Header) + sizeOf(size_class))) Header{size_class, this};
    bytes_ += sizeOf(size_class);
    use(size_class);
    return header;
  }

  void give(Header* header) {
    bool is_last = false;
    {
      const std::lock_guard lock(mutex_);
      const auto size_class = static_cast<std::size_t>(header->size_class);
      auto* const block = reinterpret_cast<Waiting*>(header);
      block->next = std::exchange(waiting_[size_class], block);
      --in_use_;
      bytes_in_use_ -= sizeOf(static_cast<int>(size_class));
      if (is_abandoned_) releaseWaiting();
      is_last = is_abandoned_ && in_use_ == 0;
    }
    if (is_last) delete this;
  }

  void release() {
    const std::lock_guard lock(mutex_);
    releaseWaiting();
  }

  void trim() {
    const std::lock_guard lock(mutex_);
    if (bytes_ > 2 * std::exchange(most_bytes_in_use_, bytes_in_use_)) releaseWaiting();
  }

  void abandon() {
    bool is_last = false;
    {
      const std::lock_guard lock(mutex_);
      releaseWaiting();
      is_abandoned_ = true;
      is_last = in_use_ == 0;
    }
    if (is_last) delete this;
  }

  std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  struct Waiting {
    Header header;
    Waiting* next;  ///< where the block's content was
  };

  void use(int size_class) {
    ++in_use_;
    bytes_in_use_ += sizeOf(size_class);
    most_bytes_in_use_ = std::max(most_bytes_in_use_, bytes_in_use_);
  }

  /// Before there is no memory left, what waits for others is given back.
  void* fromHeap(std::size_t bytes) {
    void* const memory = ::operator new(bytes, std::nothrow);
    if (memory != nullptr) return memory;
    releaseWaiting();
    return ::operator new(bytes);
  }

  void releaseWaiting() {
    for (int c = 0; c < std::ssize(waiting_); ++c) {
      while (waiting_[c] != nullptr) {
        Waiting* const block = std::exchange(waiting_[c], waiting_[c]->next);
        bytes_ -= sizeOf(c);
        ::operator delete(block);
      }
    }
  }

  mutable std::mutex mutex_;
  std::array<Waiting*, classes> waiting_ = {};
  std::size_t bytes_ = 0, bytes_in_use_ = 0, most_bytes_in_use_ = 0;
  std::int64_t in_use_ = 0;  ///< blocks
  bool is_abandoned_ = false;
};

Workspace::Workspace() : store_(new Store) {}

Workspace::~Workspace() {
  store_->abandon();
}

void Workspace::release() {
  store_->release();
}

void Workspace::trim() {
  store_->trim();
}

std::size_t Workspace::bytes() const {
  return store_->bytes();
}

Workspace* Workspace::current() {
  return current_workspace;
}

Workspace::Scope::Scope(Workspace* workspace) : outer_(std::exchange(current_workspace, workspace)) {}

Workspace::Scope::~Scope() {
  current_workspace = outer_;
}

void* takeBlock(std::size_t bytes) {
  Workspace* const workspace = current_workspace;
  // What is larger than any class is no request that could succeed, and the heap says so.
  const bool is_huge = bytes > sizeOf(classes - 1);
  if (workspace != nullptr && !is_huge) return workspace->store_->take(bytes) + 1;
  return new (::operator new(sizeof(Owner) + bytes)) Owner(nullptr) + 1;
}

void giveBlock(void* memory) noexcept {
  if (memory == nullptr) return;
  Owner* const owner = static_cast<Owner*>(memory) - 1;
  if (*owner == nullptr)
    ::operator delete(owner);
  else
    (*owner)->give(static_cast<Header*>(memory) - 1);
}

}  // namespace tufted
