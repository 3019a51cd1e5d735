#include "proto/line_rate.h"

#include <linux/tcp.h>  // the C library's tcp_info lacks tcpi_delivery_rate
#include <netinet/in.h>
#include <sys/socket.h>

namespace ninefold {

double deliveryRate(int socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
  return static_cast<double>(info.tcpi_delivery_rate);
}

}  // namespace ninefold
