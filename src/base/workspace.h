#pragma once

#include <cstddef>
#include <memory>

namespace tufted {

/// A pool of memory that one build gives back and the next one takes again.
///
/// While a Scope lasts, arrays that its thread makes (see Buffer) take their memory from the workspace; otherwise from
/// the heap. A block knows where it came from, so arrays may outlive the scope and the workspace, and may be destroyed
/// in any thread.
///
/// Sizes are rounded up to one of four per power of two, and an unused block serves requests of its own size only. So a
/// build that makes the same requests as the one before, in any order, takes nothing from the heap: of each size the
/// workspace holds as many blocks as a build had in use at once.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// Gives all unused blocks back to the heap.
  void release();

  /// Gives blocks that were not used since the last call back to the heap: builds of changing size leave blocks of
  /// sizes that are not asked for again.
  void trim();

  /// Bytes taken from the heap, in use or not.
  std::size_t bytes() const;

  /// The workspace of the innermost scope of the calling thread, or null.
  static Workspace* current();

  /// Sets the current workspace of the calling thread; null: the heap.
  class Scope {
   public:
    explicit Scope(Workspace* workspace);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Workspace* const outer_;
  };

  /// Shared by the workspace and the blocks that are in use.
  class Store;

 private:
  friend void* takeBlock(std::size_t bytes);
  const std::shared_ptr<Store> store_;
};

/// Memory from the current workspace, or else from the heap; aligned for pointers. Any thread may give it back by
/// giveBlock().
void* takeBlock(std::size_t bytes);
void giveBlock(void* memory) noexcept;

/// Base of classes whose objects are allocated by takeBlock().
struct InWorkspace {
  static void* operator new(std::size_t bytes) { return takeBlock(bytes); }
  static void operator delete(void* memory) noexcept { giveBlock(memory); }
};

}  // namespace tufted
