#include "common/base/file_lock.h"

#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "common/base/error.h"
#include "common/base/written_file.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

fs::path besideOf(const fs::path& file) {
  const fs::path target = targetOf(file);
  return target.parent_path() / (".ninefold." + target.filename().string() + ".lock");
}

// Whether the name still leads to what was locked: who had it before takes the file away.
bool isThere(int fd, const fs::path& name) {
  struct stat locked {
  }, named{};
  return ::fstat(fd, &locked) == 0 && ::stat(name.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(const fs::path& file) : beside_(besideOf(file)) {
  do {
    fd_ = Descriptor(
        ::open(beside_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
    if (!fd_) fail("cannot lock {}: {}: {}", file.string(), beside_.string(), ::strerror(errno));
    if (::flock(fd_.get(), LOCK_EX | LOCK_NB) == 0) continue;
    if (errno == EWOULDBLOCK)
      fail("{} is in use by another run; end that, or give another file", file.string());
    fail("cannot lock {}: {}", file.string(), ::strerror(errno));
  } while (!isThere(fd_.get(), beside_));
}

FileLock::~FileLock() { ::unlink(beside_.c_str()); }

}  // namespace ninefold
