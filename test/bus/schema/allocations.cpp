#include "allocations.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

thread_local priamos::bus::Allocations g_allocations;

}  // namespace

namespace priamos::bus {

void Allocations::Reset() {
  g_allocations = {};
}

Allocations Allocations::SinceReset() {
  return g_allocations;
}

}  // namespace priamos::bus

// Replaces the allocator of this test executable with one that counts.
void* operator new(std::size_t size) {
  g_allocations.count += 1;
  g_allocations.bytes += size;
  g_allocations.largest = std::max(g_allocations.largest, size);
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
// What std::stable_sort asks for; it must come from where `delete` returns it to.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
