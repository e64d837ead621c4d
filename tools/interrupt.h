#pragma once

/// From here on the first Ctrl-C only sets a flag, the second ends the process.
void catchInterrupt();

/// Whether Ctrl-C was pressed.
bool interrupted();
