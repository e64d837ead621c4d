#pragma once

/// After this call the first Ctrl-C, SIGTERM or SIGHUP only sets a flag; a second one of its kind ends the process.
/// Signals that are ignored stay ignored, such as SIGHUP under nohup.
void catchInterrupt();

/// After this call Ctrl-C, SIGTERM and SIGHUP end the process again, as does one that was received before.
void releaseInterrupt();

/// Whether Ctrl-C, SIGTERM or SIGHUP has been received.
bool interrupted();
