// SPDX-License-Identifier: MIT
// See file.h. Both systems have stat.
#include "file.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

int system_file_open_regular(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        return -1;
    }
    if (!S_ISREG(status.st_mode)) {
        errno = S_ISDIR(status.st_mode) ? EISDIR : 0;
        return -1;
    }
    const int descriptor = system_file_open(path, SYSTEM_FILE_READ);
    if (descriptor >= 0 && (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
        close(descriptor); // it has been replaced meanwhile
        errno = 0;
        return -1;
    }
    return descriptor;
}
