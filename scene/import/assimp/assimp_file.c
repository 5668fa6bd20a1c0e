// SPDX-License-Identifier: MIT
// The files that assimp opens while it reads a model: regular ones, within the bounds that import->confine sets.
#include <assimp/cfileio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "assimp.h"
#include "file.h"
#include "import/builder/confine.h"

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_file(struct aiFile *file, char *buffer, size_t size, size_t count)
{
    return fread(buffer, size, count, stream_of(file));
}

static size_t write_nothing(struct aiFile *file, const char *buffer, size_t size, size_t count)
{
    (void)file, (void)buffer, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    const long place = ftell(stream_of(file));
    return place < 0 ? 0 : (size_t)place;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    const int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseek(stream_of(file), (long)offset, whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static size_t size_of(struct aiFile *file)
{
    FILE *const stream = stream_of(file);
    const long place = ftell(stream);
    fseek(stream, 0, SEEK_END);
    const long size = ftell(stream);
    fseek(stream, place, SEEK_SET);
    return size < 0 ? 0 : (size_t)size;
}

static void flush(struct aiFile *file)
{
    (void)file;
}

// Files in memory ------------------------------------------------------------------------------------

struct memory {
    char *bytes;
    size_t size, place;
};

static struct memory *memory_of(struct aiFile *file)
{
    return (struct memory *)(void *)file->UserData;
}

static size_t read_memory(struct aiFile *file, char *buffer, size_t size, size_t count)
{
    struct memory *const memory = memory_of(file);
    const size_t whole = size == 0 ? 0 : (memory->size - memory->place) / size;
    const size_t read = count < whole ? count : whole;
    memcpy(buffer, memory->bytes + memory->place, read * size);
    memory->place += read * size;
    return read;
}

static size_t tell_memory(struct aiFile *file)
{
    return memory_of(file)->place;
}

static enum aiReturn seek_memory(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    struct memory *const memory = memory_of(file);
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? memory->place : memory->size;
    const size_t place = base + offset; // an offset below 0 wraps around
    if (place > memory->size) {
        return aiReturn_FAILURE;
    }
    memory->place = place;
    return aiReturn_SUCCESS;
}

static size_t size_of_memory(struct aiFile *file)
{
    return memory_of(file)->size;
}

// Return true for a file that may be Collada, by the ending of its name.
static bool may_be_collada(const struct scene_import *import)
{
    const char *const ending = import->ending;
    return ending[0] == 0 || strcasecmp(ending, "dae") == 0 || strcasecmp(ending, "xml") == 0;
}

// Make a file of bytes, which are its own then. Return NULL if there is not enough memory.
static struct aiFile *open_memory(struct memory memory)
{
    struct aiFile *const file = malloc(sizeof *file);
    struct memory *const kept = file == NULL ? NULL : malloc(sizeof *kept);
    if (kept == NULL) {
        free(file);
        free(memory.bytes);
        return NULL;
    }
    *kept = memory;
    *file = (struct aiFile){.ReadProc = read_memory,
                            .WriteProc = write_nothing,
                            .TellProc = tell_memory,
                            .FileSizeProc = size_of_memory,
                            .SeekProc = seek_memory,
                            .FlushProc = flush,
                            .UserData = (aiUserData)(void *)kept};
    return file;
}

// Open a Collada file as assimp can read it. Return NULL if it is none.
static struct aiFile *open_collada(const char *path)
{
    const char *problem = NULL;
    struct memory memory = {0};
    memory.bytes = scene_import_read_bytes(path, &memory.size, &problem);
    if (memory.bytes == NULL || strstr(memory.bytes, "<COLLADA") == NULL) {
        free(memory.bytes);
        return NULL;
    }
    scene_assimp_collapse_texts(memory.bytes, memory.size);
    scene_assimp_number_sets(memory.bytes, memory.size);
    memory.bytes = scene_assimp_name_images(memory.bytes, &memory.size);
    return open_memory(memory);
}

// Open a text of DXF with the entities that assimp knows. Return NULL if it is none.
static struct aiFile *open_dxf(struct scene_import *import)
{
    static const char binary[] = "AutoCAD Binary DXF";
    const char *problem = NULL;
    struct memory memory = {0};
    memory.bytes = scene_import_read_bytes(import->model.path, &memory.size, &problem);
    if (memory.bytes == NULL || strncmp(memory.bytes, binary, sizeof binary - 1) == 0) {
        free(memory.bytes);
        return NULL;
    }
    memory.bytes = scene_assimp_flatten_dxf(import, memory.bytes, &memory.size);
    return open_memory(memory);
}

// Open the model as assimp can read it. Return NULL if it can read it as it is.
static struct aiFile *open_changed(struct scene_import *import)
{
    if (strcasecmp(import->ending, "dxf") == 0) {
        return open_dxf(import);
    }
    return may_be_collada(import) ? open_collada(import->model.path) : NULL;
}

static void close_memory(struct aiFile *file)
{
    free(memory_of(file)->bytes);
    free(memory_of(file));
    free(file);
}

static struct aiFile *open_file(struct aiFileIO *files, const char *path, const char *mode)
{
    struct scene_import *const import = (struct scene_import *)(void *)files->UserData;
    const bool is_model = strcmp(path, import->model.path) == 0;
    const bool may_read = mode[0] == 'r' && (is_model || scene_import_within(import, path));
    struct aiFile *const changed = may_read && is_model ? open_changed(import) : NULL;
    if (changed != NULL) {
        return changed;
    }
    const int descriptor = may_read ? system_file_open_regular(path) : -1;
    FILE *const stream = descriptor >= 0 ? fdopen(descriptor, "rb") : NULL;
    if (stream == NULL && descriptor >= 0) {
        close(descriptor);
    }
    struct aiFile *const file = stream != NULL ? malloc(sizeof *file) : NULL;
    if (file == NULL) {
        if (stream != NULL) {
            fclose(stream);
        }
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = read_file,
                            .WriteProc = write_nothing,
                            .TellProc = tell,
                            .FileSizeProc = size_of,
                            .SeekProc = seek,
                            .FlushProc = flush,
                            .UserData = (aiUserData)(void *)stream};
    return file;
}

static void close_file(struct aiFileIO *files, struct aiFile *file)
{
    (void)files;
    if (file->ReadProc == read_memory) {
        close_memory(file);
        return;
    }
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO scene_assimp_files(struct scene_import *import)
{
    return (struct aiFileIO){
        .OpenProc = open_file, .CloseProc = close_file, .UserData = (aiUserData)(void *)import};
}
