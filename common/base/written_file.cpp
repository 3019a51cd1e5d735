#include "common/base/written_file.h"

#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

#include "common/base/error.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".ninefold.", kSuffix = ".part";
constexpr int kMostLinks = 40;    // that the kernel follows
constexpr int kMostTries = 1000;  // names beside the target, taken by what killed processes left

const char* kindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

// A file that was mounted by itself (into a container, say) cannot be replaced by a rename.
bool isMount(const fs::path& name) {
  struct statx facts {};
  return ::statx(AT_FDCWD, name.c_str(), 0, STATX_TYPE, &facts) == 0 &&
         (facts.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

void checkFolder(const fs::path& name, const fs::path& folder) {
  struct stat facts {};
  if (::stat(folder.c_str(), &facts) != 0) {
    if (errno == ENOENT)
      fail("cannot write {}: there is no folder {}; create it first", name.string(),
           folder.string());
    fail("cannot write {}: {}: {}", name.string(), folder.string(), ::strerror(errno));
  }
  if (!S_ISDIR(facts.st_mode))
    fail("cannot write {}: {} is no folder; choose another name", name.string(), folder.string());
}

// What is there already, if anything.
void checkOldFile(const fs::path& name, const FileRights& rights) {
  struct stat facts {};
  if ((rights.mayReplace ? ::stat : ::lstat)(name.c_str(), &facts) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return;  // the folder tells more
    fail("cannot write {}: {}; choose another name", name.string(), ::strerror(errno));
  }
  if (!rights.mayReplace)
    fail("cannot write {}: it exists already and is not overwritten; choose another name",
         name.string());
  if (!S_ISREG(facts.st_mode))
    fail("cannot write {}: it is {}, no regular file; choose another name", name.string(),
         kindOf(facts.st_mode));
  if (isMount(name))
    fail("cannot write {}: the file is mounted by itself and cannot be replaced; mount its folder",
         name.string());
  if (::faccessat(AT_FDCWD, name.c_str(), W_OK, AT_EACCESS) != 0)
    fail("cannot write {}: it is write-protected ({}); choose another name", name.string(),
         ::strerror(errno));
}

fs::path checkedTarget(const fs::path& name, const FileRights& rights) {
  if (!name.has_filename())
    fail("cannot write {}: the name is that of no file; choose another", name.string());
  checkOldFile(name, rights);
  fs::path target = targetOf(name);
  checkFolder(name, target.parent_path());
  return target;
}

bool lock(int fd) { return ::flock(fd, LOCK_EX | LOCK_NB) == 0; }

// False if somebody who sweeps was quicker than our lock.
bool isThere(int fd) {
  struct stat facts {};
  return ::fstat(fd, &facts) == 0 && facts.st_nlink > 0;
}

// Takes away what killed writers left in the folder: what can be locked has no writer any more.
void sweep(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
    const Descriptor fd(::open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (fd && lock(fd.get())) ::unlink(it->path().c_str());
  }
}

}  // namespace

fs::path targetOf(const fs::path& name) {
  fs::path target = fs::absolute(name);
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code isNoLink;
    const fs::path link = fs::read_symlink(target, isNoLink);
    if (isNoLink) break;
    target = target.parent_path() / link;  // a link that begins at the root stands for itself
  }
  std::error_code isNowhere;
  const fs::path folder = fs::weakly_canonical(target.parent_path(), isNowhere);
  return isNowhere ? target : folder / target.filename();
}

WrittenFile::WrittenFile(const fs::path& name, FileRights rights)
    : name_(name), target_(checkedTarget(name, rights)), mayReplace_(rights.mayReplace) {
  createBeside(rights.mode);
  inheritRights();
}

WrittenFile::~WrittenFile() {
  if (!beside_.empty()) ::unlink(beside_.c_str());
}

void WrittenFile::failWith(int error) const {
  fail("cannot write {}: {}", name_.string(), ::strerror(error));
}

void WrittenFile::createBeside(mode_t mode) {
  static std::atomic<uint64_t> count = 0;
  const fs::path folder = target_.parent_path();
  for (int i = 0; i < kMostTries; ++i) {
    const fs::path path = folder / fmt::format("{}{}.{}{}", kPrefix, ::getpid(), count++, kSuffix);
    fd_.reset(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    if (!fd_ && errno == EEXIST) continue;
    if (!fd_)
      fail("cannot write {}: no file can be created in {} ({})", name_.string(), folder.string(),
           ::strerror(errno));
    // A file system without locks is not swept either.
    if ((lock(fd_.get()) || errno != EWOULDBLOCK) && isThere(fd_.get())) {
      beside_ = path;
      return;
    }
  }
  fail("cannot write {}: {} is full of {}*{}; remove them", name_.string(), folder.string(),
       kPrefix, kSuffix);
}

void WrittenFile::inheritRights() {
  struct stat old {};
  if (::stat(target_.c_str(), &old) != 0) return;
  // Only the system's administrator may give a file away; the mode comes after, as this clears bits
  // of it.
  [[maybe_unused]] const int ignored = ::fchown(fd_.get(), old.st_uid, old.st_gid);
  if (::fchmod(fd_.get(), old.st_mode & 07777) != 0) failWith(errno);
}

void WrittenFile::writeAt(uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(fd_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) failWith(failure_ = n < 0 ? errno : ENOSPC);
    offset += static_cast<uint64_t>(n);
    bytes.remove_prefix(static_cast<size_t>(n));
    size_ = std::max(size_, offset);
  }
}

void WrittenFile::reserve(uint64_t bytes) {
  if (bytes == 0) return;
  while (::fallocate(fd_.get(), 0, 0, static_cast<off_t>(bytes)) != 0) {
    if (errno == EINTR) continue;
    if (errno == EOPNOTSUPP || errno == ENOSYS) return;
    fail("cannot write {}: {}; it needs about {:.1f} MB", name_.string(), ::strerror(errno),
         static_cast<double>(bytes) / 1e6);
  }
}

void WrittenFile::takeWhatIsThere() {
  struct stat facts {};
  if (::fstat(fd_.get(), &facts) != 0) failWith(errno);
  size_ = static_cast<uint64_t>(facts.st_size);
}

void WrittenFile::publish() {
  if (failure_ != 0) failWith(failure_);
  // EINVAL: a file system that cannot.
  if (::fsync(fd_.get()) != 0 && errno != EINVAL) failWith(errno);
  struct stat facts {};
  if (::fstat(fd_.get(), &facts) != 0) failWith(errno);
  if (static_cast<uint64_t>(facts.st_size) != size_)
    fail("cannot write {}: only {} of {} bytes arrived; is the disk full?", name_.string(),
         facts.st_size, size_);
  if (!mayReplace_) {  // the destructor removes the other name
    if (::link(beside_.c_str(), target_.c_str()) != 0) failWith(errno);
    return;
  }
  if (::rename(beside_.c_str(), target_.c_str()) != 0) failWith(errno);
  beside_.clear();
}

void checkWritable(const fs::path& name, uint64_t bytes) {
  WrittenFile trial(name);
  trial.reserve(bytes);
  sweep(targetOf(name).parent_path());
}

void writeFile(const fs::path& name, std::string_view bytes, FileRights rights) {
  WrittenFile file(name, rights);
  file.write(bytes);
  file.publish();
}

}  // namespace ninefold
