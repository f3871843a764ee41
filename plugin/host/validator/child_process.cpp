// SPDX-License-Identifier: Apache-2.0
#include "validator/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>

#include "nscdd/error.h"

namespace nscdd {
namespace {

// What the child writes into the pipe before its sentence, so that a silent exit is told from success.
constexpr char kReturned = 'r';
constexpr char kThrew = 't';

void Write(int pipe, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = write(pipe, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    done += static_cast<std::size_t>(written);
  }
}

[[noreturn]] void BeChild(const std::function<void()>& function, int pipe) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  std::string message(1, kThrew);
  try {
    function();
    message = kReturned;
  } catch (const std::exception& e) {
    message += e.what();
  } catch (...) {
    message += "it threw something that is no std::exception";
  }
  Write(pipe, message);
  _exit(0);
}

// Everything the child writes until it closes the pipe; false when time is up first.
bool ReadUntilEnd(int pipe, double seconds, std::string* text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd entry{pipe, POLLIN, 0};
    if (poll(&entry, 1, static_cast<int>(left)) <= 0) continue;
    char buffer[4096];
    const ssize_t count = read(pipe, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text->append(buffer, static_cast<std::size_t>(count));
  }
}

int WaitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string Judge(const std::string& text, int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("it crashed with signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) != 0 || text.empty()) {
    return fmt::format("it ended the process with exit code {}", WEXITSTATUS(status));
  }
  if (text[0] == kReturned) return "";
  return text.size() > 1 ? text.substr(1) : "it failed without a sentence";
}

}  // namespace

ChildOutcome RunInChild(const std::function<void()>& function, double seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw Error(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) {
    const std::string reason = std::strerror(errno);
    close(ends[0]);
    close(ends[1]);
    throw Error(fmt::format("cannot start a child process: {}", reason));
  }
  if (child == 0) {
    close(ends[0]);
    BeChild(function, ends[1]);
  }
  close(ends[1]);
  std::string text;
  const bool ended = ReadUntilEnd(ends[0], seconds, &text);
  if (!ended) kill(child, SIGKILL);
  close(ends[0]);
  const int status = WaitFor(child);
  return {ended ? Judge(text, status) : fmt::format("no answer within {} s; it was stopped", seconds)};
}

}  // namespace nscdd
