// This library is preloaded into a process. It lets the system calls fail that ISOJAM_FAIL names. "read 7 5" sets errno
// to 5 (EIO) in the seventh read; "read 7+ 5" does so in the seventh and all later ones. With "count" instead of a
// number, no call fails, and the number of calls is printed at the end. Several orders are separated by ";". Calls:
// malloc, open, read, write, fsync, syncdir (fsync of a directory), rename, renameat2, link, thread.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
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
};

Order read_order(const char* text) {
  Order order;
  char which[24] = "";
  std::sscanf(text, "%15s %23s %d", order.call, which, &order.error);
  order.count = std::strcmp(which, "count") == 0;
  order.first = std::atol(which);
  order.ever_after = std::strchr(which, '+') != nullptr;
  return order;
}

constexpr std::size_t most_orders = 4;
using Orders = std::array<Order, most_orders>;

Orders read_orders() {
  Orders all;
  const char* text = std::getenv("ISOJAM_FAIL");
  for (std::size_t k = 0; text && k < most_orders; ++k) {
    all[k] = read_order(text);
    text = std::strchr(text, ';');
    if (text) ++text;
  }
  return all;
}

const Orders& orders() {
  static const Orders the_orders = read_orders();
  return the_orders;
}

std::array<std::atomic<long>, most_orders> calls;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// True, with errno set, if this call must fail.
bool fails(const char* call) {
  for (std::size_t i = 0; i < most_orders; ++i) {
    const Order& what = orders()[i];
    if (std::strcmp(call, what.call) != 0) continue;
    const long k = ++calls[i];
    if (what.count || k < what.first || (k > what.first && !what.ever_after)) continue;
    errno = what.error;
    return true;
  }
  return false;
}

bool is_directory(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 && S_ISDIR(status.st_mode);
}

__attribute__((destructor)) void say_count() {
  if (!orders()[0].count) return;
  char text[64];
  const int size = std::snprintf(text, sizeof text, "%s calls: %ld\n", orders()[0].call, calls[0].load());
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
  return fails("open") ? -1 : real(path, flags, mode);
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
  return fails("fsync") || (is_directory(fd) && fails("syncdir")) ? -1 : real(fd);
}
int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return fails("rename") ? -1 : real(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  static const auto real = next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
  return fails("renameat2") ? -1 : real(from_folder, from, to_folder, to, flags);
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
