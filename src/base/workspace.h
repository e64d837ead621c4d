#pragma once

#include <cstddef>
#include <memory>

namespace tufted {

/// Memory that one build gives back and the next one takes again.
///
/// While a Scope lasts, arrays that its thread makes (see Buffer) take their memory from the workspace; without one
/// they take it from the heap. A block knows where it came from, so arrays may outlive the scope, and the workspace
/// too, and may be destroyed in any thread.
///
/// Sizes are rounded up to one of four per power of two, and a block that waits serves requests of its own size alone.
/// So a build that asks for what the one before asked for, in whatever order, finds all of it: for each size as many
/// blocks are held as one build had in use at one time.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// Gives the blocks that nobody uses back to the heap.
  void release();

  /// Gives back to the heap the blocks that nobody has used since the last call. Builds of changing size leave blocks
  /// of sizes that none asks for again.
  void trim();

  /// Bytes taken from the heap, in use or not.
  std::size_t bytes() const;

  /// The workspace of the innermost scope of the calling thread, or null.
  static Workspace* current();

  /// Makes a workspace that of the calling thread, or none if null.
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

/// Memory from the current workspace, or else from the heap; aligned for pointers. Any thread may give it back.
void* takeBlock(std::size_t bytes);
void giveBlock(void* memory) noexcept;

/// Base of classes whose objects are such blocks.
struct InWorkspace {
  static void* operator new(std::size_t bytes) { return takeBlock(bytes); }
  static void operator delete(void* memory) noexcept { giveBlock(memory); }
};

}  // namespace tufted
