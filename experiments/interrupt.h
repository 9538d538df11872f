// Ctrl-C and SIGTERM: the first one asks to stop after the records at work, the second one kills.
#pragma once

namespace drape {

/// Installs the handlers. Long loops poll interrupted() between records.
void catch_interrupts();

/// True once SIGINT or SIGTERM has arrived.
bool interrupted();

}  // namespace drape
