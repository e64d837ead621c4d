#pragma once

/// From here on the first Ctrl-C, SIGTERM or SIGHUP only sets a flag; a second of its kind ends the process. Signals
/// that are ignored stay ignored, such as SIGHUP under nohup.
void catchInterrupt();

/// From here on every Ctrl-C, SIGTERM and SIGHUP ends the process again; so does one that has been received already.
void releaseInterrupt();

/// Whether Ctrl-C, SIGTERM or SIGHUP has been received.
bool interrupted();
