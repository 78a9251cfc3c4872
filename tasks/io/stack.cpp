#include "tasks/io/stack.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <system_error>

namespace isojam {
namespace {

/// The usual limit on Linux. Eigen alone puts matrices of up to 128 KiB on the stack.
constexpr rlim_t needed = rlim_t{8} << 20;

struct Call {
  const std::function<int()>& work;
  int result = 0;
};

void throw_if(int error) {
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot create a thread with enough stack");
}

}  // namespace

int with_enough_stack(const std::function<int()>& work) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= needed) return work();
  pthread_attr_t attributes;
  throw_if(::pthread_attr_init(&attributes));
  throw_if(::pthread_attr_setstacksize(&attributes, needed));
  throw_if(::pthread_setattr_default_np(&attributes));
  throw_if(::pthread_attr_destroy(&attributes));
  Call call{work};
  pthread_t thread{};
  throw_if(::pthread_create(
      &thread, nullptr,
      [](void* given) -> void* {
        auto& here = *static_cast<Call*>(given);
        here.result = here.work();
        return nullptr;
      },
      &call));
  throw_if(::pthread_join(thread, nullptr));
  return call.result;
}

}  // namespace isojam
