// SPDX-License-Identifier: Apache-2.0
// roscpp gathers what has happened to its sockets, and then goes through it one by one. Where a connection ends
// meanwhile, its number is soon that of a new one, which would be closed for what happened to the old: whoever has just
// called a service gets no answer. roscpp passes over such stale events only where they are errors, and the end of the
// other side (POLLRDHUP) is not one of them. So each is told as POLLHUP too; what is no mistake is told again.
// What a program defines comes before what its libraries do, so this serves roscpp in the programs it is linked into.
#include <dlfcn.h>
#include <poll.h>
#include <ros/io.h>

#include <type_traits>

namespace ros {

static_assert(std::is_same_v<socket_pollfd, ::pollfd> && std::is_same_v<nfds_t, unsigned long>,
              "the name below is that of the function with these arguments");

pollfd_vector_ptr poll_sockets(int epfd, socket_pollfd* fds, nfds_t nfds, int timeout) {
  using Poll = pollfd_vector_ptr (*)(int, socket_pollfd*, nfds_t, int);
  static const auto poll = reinterpret_cast<Poll>(::dlsym(RTLD_NEXT, "_ZN3ros12poll_socketsEiP6pollfdmi"));
  pollfd_vector_ptr happened = poll(epfd, fds, nfds, timeout);
  if (!happened) return happened;
  for (socket_pollfd& socket : *happened) {
    if ((socket.revents & POLLRDHUP) != 0) socket.revents = static_cast<short>(socket.revents | POLLHUP);
  }
  return happened;
}

}  // namespace ros
