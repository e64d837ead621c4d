#pragma once

/// Peak memory of this process in MB.
double peakMemory();
