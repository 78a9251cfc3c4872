// This library is preloaded into a process. It lets the system calls fail that ISOJAM_FAIL names. "read 7 5" sets errno
// to 5 (EIO) in the seventh read; "read 7+ 5" does so in the seventh and all later ones. With "count" instead of a
// number, no call fails, and the number of calls is printed at the end. "open count 0 records/a.json" counts the opened
// paths that end in this way. Calls: malloc, open, read, write, fsync, rename, link, thread.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Order {
  char call[16] = "";
  long first = 0;
  bool ever_after = false, count = false;
  int error = 0;
  char path[256] = "";  ///< end of the paths that count; empty for all paths
};

Order read_order() {
  Order order;
  const char* text = std::getenv("ISOJAM_FAIL");
  if (!text) return order;
  char which[24] = "";
  std::sscanf(text, "%15s %23s %d %255s", order.call, which, &order.error, order.path);
  order.count = std::strcmp(which, "count") == 0;
  order.first = std::atol(which);
  order.ever_after = std::strchr(which, '+') != nullptr;
  return order;
}

const Order& order() {
  static const Order the_order = read_order();
  return the_order;
}

std::atomic<long> calls{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// True, with errno set, if this call must fail.
bool fails(const char* call) {
  const Order& what = order();
  if (std::strcmp(call, what.call) != 0) return false;
  const long k = ++calls;
  if (what.count || k < what.first || (k > what.first && !what.ever_after)) return false;
  errno = what.error;
  return true;
}

bool is_counted(const char* path) {
  const auto size = std::strlen(path), end = std::strlen(order().path);
  return size >= end && std::strcmp(path + size - end, order().path) == 0;
}

__attribute__((destructor)) void say_count() {
  if (!order().count) return;
  char text[64];
  const int size = std::snprintf(text, sizeof text, "%s calls: %ld\n", order().call, calls.load());
  if (::write(STDERR_FILENO, text, static_cast<std::size_t>(size)) < 0) std::abort();
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

}  // namespace

// NOLINTBEGIN(*-naming,*-parameter-name,cert-dcl50-cpp,cert-dcl58-cpp): as the C library has them
extern "C" {

void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) { return fails("malloc") ? nullptr : __libc_malloc(size); }

static int opened(const char* path, int flags, mode_t mode) {
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  return is_counted(path) && fails("open") ? -1 : real(path, flags, mode);
}
int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = static_cast<mode_t>(va_arg(rest, int));
  va_end(rest);
  return opened(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = static_cast<mode_t>(va_arg(rest, int));
  va_end(rest);
  return opened(path, flags, mode);
}
ssize_t read(int fd, void* buffer, std::size_t size) {
  static const auto real = next<ssize_t (*)(int, void*, std::size_t)>("read");
  return fails("read") ? -1 : real(fd, buffer, size);
}
ssize_t write(int fd, const void* buffer, std::size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  return fails("write") ? -1 : real(fd, buffer, size);
}
int fsync(int fd) {
  static const auto real = next<int (*)(int)>("fsync");
  return fails("fsync") ? -1 : real(fd);
}
int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return fails("rename") ? -1 : real(from, to);
}
int link(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("link");
  return fails("link") ? -1 : real(from, to);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto real = next<Create>("pthread_create");
  return fails("thread") ? errno : real(thread, attributes, work, argument);
}

}  // extern "C"
// NOLINTEND(*-naming,*-parameter-name,cert-dcl50-cpp,cert-dcl58-cpp)
