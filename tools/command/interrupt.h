#pragma once

/// From here on the first Ctrl-C, SIGTERM or SIGHUP only sets a flag; a second of its kind ends the process. Those that
/// are ignored stay so, as SIGHUP under nohup.
void catchInterrupt();

/// From here on each of them ends the process again.
void releaseInterrupt();

/// Whether one of them came.
bool interrupted();
