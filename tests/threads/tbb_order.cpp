// Shows ThreadSanitizer which of TBB's calls come before which: Debian's libtbb is built without it, so its own atomic
// operations are not seen, and every value handed to a task would be reported as a race. The linker puts these in the
// places of TBB's functions (--wrap), so no race in our own code is suppressed.
#include <oneapi/tbb/detail/_small_object_pool.h>
#include <oneapi/tbb/detail/_task.h>

#include <sanitizer/tsan_interface.h>
#include <new>

namespace {

using tbb::detail::d1::execution_data;
using tbb::detail::d1::slot_id;
using tbb::detail::d1::small_object_pool;
using tbb::detail::d1::task;
using tbb::detail::d1::task_group_context;
using tbb::detail::d1::wait_context;

constexpr std::align_val_t TASK_ALIGNMENT{alignof(task)};

/// In the place of a task that was spawned: what the spawning thread wrote before comes before its execution.
class Spawned final : public task {
 public:
  explicit Spawned(task& real) : real_(real) { __tsan_release(this); }

  task* execute(execution_data& data) override {
    __tsan_acquire(this);
    return ended(real_.execute(data));  // when it throws, TBB cancels this task next
  }
  task* cancel(execution_data& data) override {
    __tsan_acquire(this);
    return ended(real_.cancel(data));
  }

 private:
  task* ended(task* next) {
    delete this;
    return next;
  }

  task& real_;
};

}  // namespace

// Names as the linker's --wrap has them: "real" is TBB's function, "wrap" what is called in its place.
#define TBB_REAL(name) asm("__real__ZN3tbb6detail2r1" name)
#define TBB_WRAP(name) asm("__wrap__ZN3tbb6detail2r1" name)
#define SPAWN "5spawnERNS0_2d14taskERNS2_18task_group_contextE"
#define SPAWN_AT "5spawnERNS0_2d14taskERNS2_18task_group_contextEt"
#define EXECUTE_AND_WAIT "16execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_"
#define WAIT "4waitERNS0_2d112wait_contextERNS2_18task_group_contextE"
#define ALLOCATE "8allocateERPNS0_2d117small_object_poolEm"
#define ALLOCATE_IN "8allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE"
#define DEALLOCATE "10deallocateERNS0_2d117small_object_poolEPvm"
#define DEALLOCATE_IN "10deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE"

void real_spawn(task&, task_group_context&) TBB_REAL(SPAWN);
void real_spawn(task&, task_group_context&, slot_id) TBB_REAL(SPAWN_AT);
void real_execute_and_wait(task&, task_group_context&, wait_context&, task_group_context&)
    TBB_REAL(EXECUTE_AND_WAIT);
void real_wait(wait_context&, task_group_context&) TBB_REAL(WAIT);

void wrap_spawn(task&, task_group_context&) TBB_WRAP(SPAWN);
void wrap_spawn(task&, task_group_context&, slot_id) TBB_WRAP(SPAWN_AT);
void wrap_execute_and_wait(task&, task_group_context&, wait_context&, task_group_context&)
    TBB_WRAP(EXECUTE_AND_WAIT);
void wrap_wait(wait_context&, task_group_context&) TBB_WRAP(WAIT);
void* wrap_allocate(small_object_pool*&, std::size_t) TBB_WRAP(ALLOCATE);
void* wrap_allocate(small_object_pool*&, std::size_t, const execution_data&) TBB_WRAP(ALLOCATE_IN);
void wrap_deallocate(small_object_pool&, void*, std::size_t) TBB_WRAP(DEALLOCATE);
void wrap_deallocate(small_object_pool&, void*, std::size_t, const execution_data&) TBB_WRAP(DEALLOCATE_IN);

void wrap_spawn(task& spawned, task_group_context& device) { real_spawn(*new Spawned(spawned), device); }

void wrap_spawn(task& spawned, task_group_context& device, slot_id slot) {
  real_spawn(*new Spawned(spawned), device, slot);
}

// Each task's release of the wait_context, an atomic operation in TBB's headers, comes before the end of waiting for it:
// reserve(0) is another operation on the same number.

void wrap_execute_and_wait(task& first, task_group_context& device, wait_context& awaited,
                           task_group_context& awaited_context) {
  real_execute_and_wait(first, device, awaited, awaited_context);
  awaited.reserve(0);
}

void wrap_wait(wait_context& awaited, task_group_context& device) {
  real_wait(awaited, device);
  awaited.reserve(0);
}

// The memory of tasks comes from the heap, whose reuse ThreadSanitizer sees, not from TBB's pools.

void* wrap_allocate(small_object_pool*& pool, std::size_t bytes) {
  static char no_pool = 0;  // TBB's headers ask only that there is one
  pool = reinterpret_cast<small_object_pool*>(&no_pool);
  return operator new(bytes, TASK_ALIGNMENT);
}

void* wrap_allocate(small_object_pool*& pool, std::size_t bytes, const execution_data&) {
  return wrap_allocate(pool, bytes);
}

void wrap_deallocate(small_object_pool&, void* memory, std::size_t) {
  operator delete(memory, TASK_ALIGNMENT);
}

void wrap_deallocate(small_object_pool& pool, void* memory, std::size_t bytes, const execution_data&) {
  wrap_deallocate(pool, memory, bytes);
}
