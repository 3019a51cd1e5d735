// line_rate.h: what a TCP line can take, as the kernel has measured it.
// Threads: any.
#pragma once

namespace ninefold {

// The latest rate at which a socket's data was delivered, as far as the sender kept the line busy
// [bytes/s]; 0 if nothing was measured.
double deliveryRate(int socket);

}  // namespace ninefold
