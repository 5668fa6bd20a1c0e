// SPDX-License-Identifier: MIT
#include "model_bytes.h"

#include "blob.h"
#include "memory_file.h"
#include "reader_process.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

// A mapping that is copied: a caller's memory is freed by free.
static void *copy_mapping(const struct system_memory_file *file, size_t *size)
{
    void *const mapping = system_memory_file_map(file, size);
    void *const bytes = mapping != NULL ? malloc(*size) : NULL;
    if (bytes != NULL) {
        memcpy(bytes, mapping, *size);
    }
    if (mapping != NULL) {
        system_memory_file_unmap(mapping, *size);
    }
    return bytes;
}

void *scene_model_write(const struct scene_model *model, size_t *size)
{
    struct system_memory_file file;
    if (!system_memory_file_open(&file, "rhw model")) {
        return NULL;
    }
    void *const bytes = scene_blob_write(model, file.stream) ? copy_mapping(&file, size) : NULL;
    system_memory_file_close(&file);
    return bytes;
}

struct scene_model *scene_model_read(const void *bytes, size_t size, char *error, size_t error_size)
{
    struct system_memory_file file;
    if (!system_memory_file_open(&file, "rhw model")) {
        snprintf(error, error_size, "%s", strerror(errno));
        return NULL;
    }
    struct scene_model *model = NULL;
    if (fwrite(bytes, 1, size, file.stream) == size && fflush(file.stream) == 0) {
        model = scene_import_map(&file, error, error_size);
    } else {
        snprintf(error, error_size, "there is not enough memory for the model");
    }
    system_memory_file_close(&file);
    return model;
}
