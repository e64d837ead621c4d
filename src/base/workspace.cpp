#include "base/workspace.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

namespace tufted {
namespace {

thread_local Workspace* current_workspace = nullptr;

/// Header in memory before each block.
struct alignas(std::max_align_t) Header {
  std::shared_ptr<Workspace::Store> owner;  ///< where the block returns to; null: the heap
  std::size_t bytes;                        ///< size of the block, without the header
  Header* next;                             ///< next unused block of the same size
};

Header* fromHeap(std::size_t bytes, std::shared_ptr<Workspace::Store> owner) {
  if (bytes > std::numeric_limits<std::size_t>::max() - sizeof(Header)) throw std::bad_alloc();
  return new (::operator new(sizeof(Header) + bytes)) Header{std::move(owner), bytes, nullptr};
}

void toHeap(Header* header) {
  header->~Header();
  ::operator delete(header);
}

/// Rounds a size up to one of four per power of two, so that the next build, which needs about as much, finds a block.
std::size_t roundedUp(std::size_t bytes) {
  const std::size_t step = std::max<std::size_t>(64, std::bit_floor(bytes) / 4);
  return (bytes + step - 1) / step * step;
}

}  // namespace

/// The unused blocks of a workspace, by size. Lives as long as the workspace or any block taken from it.
class Workspace::Store : public std::enable_shared_from_this<Store> {
 public:
  Header* take(std::size_t bytes) {
    bytes = roundedUp(bytes);
    const std::lock_guard lock(mutex_);
    Waiting& waiting = waiting_[bytes];
    return waiting.first != nullptr ? waiting.take() : make(bytes);
  }

  void give(Header* block) {
    const std::shared_ptr<Store> last = block->owner;  // keeps the store alive until the lock is released
    const std::lock_guard lock(mutex_);
    waiting_.find(block->bytes)->second.give(block);
    if (is_abandoned_) releaseAll();
  }

  void release() {
    const std::lock_guard lock(mutex_);
    releaseAll();
  }

  void trim() {
    const std::lock_guard lock(mutex_);
    for (auto& [bytes, waiting] : waiting_) {
      release(waiting, waiting.least);
      waiting.least = waiting.count;
    }
  }

  void abandon() {
    const std::lock_guard lock(mutex_);
    releaseAll();
    is_abandoned_ = true;
  }

  std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  /// The unused blocks of one size.
  struct Waiting {
    Header* first = nullptr;
    std::size_t count = 0, least = 0;  ///< number now, and its minimum since the last trim()

    Header* take() {
      least = std::min(least, --count);
      return std::exchange(first, first->next);
    }
    void give(Header* block) {
      ++count;
      block->next = std::exchange(first, block);
    }
  };

  /// Takes a block from the heap. If there is none, frees all unused blocks and tries again.
  Header* make(std::size_t bytes) {
    Header* block = nullptr;
    try {
      block = fromHeap(bytes, shared_from_this());
    } catch (const std::bad_alloc&) {
      releaseAll();
      block = fromHeap(bytes, shared_from_this());
    }
    bytes_ += bytes;
    return block;
  }

  void release(Waiting& waiting, std::size_t count) {
    for (; count > 0; --count) {
      bytes_ -= waiting.first->bytes;
      toHeap(waiting.take());
    }
  }

  void releaseAll() {
    for (auto& [bytes, waiting] : waiting_) release(waiting, waiting.count);
  }

  mutable std::mutex mutex_;
  std::map<std::size_t, Waiting> waiting_;
  std::size_t bytes_ = 0;
  bool is_abandoned_ = false;
};

Workspace::Workspace() : store_(std::make_shared<Store>()) {}

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
  // A size too large to round up goes to the heap, which throws.
  const bool is_huge = bytes > std::numeric_limits<std::size_t>::max() / 2;
  return (workspace != nullptr && !is_huge ? workspace->store_->take(bytes) : fromHeap(bytes, nullptr)) + 1;
}

void giveBlock(void* memory) noexcept {
  if (memory == nullptr) return;
  Header* const block = static_cast<Header*>(memory) - 1;
  if (block->owner == nullptr)
    toHeap(block);
  else
    block->owner->give(block);
}

}  // namespace tufted
