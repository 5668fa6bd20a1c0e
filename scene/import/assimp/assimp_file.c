// SPDX-License-Identifier: MIT
// The files that assimp opens while it reads a model: regular ones, within the bounds that import->confine sets. Some
// models are given to it in another form than their files have.
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
    const char *bytes; // they outlive the file
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

static bool is_zae(const struct scene_import *import)
{
    return strcasecmp(import->ending, "zae") == 0;
}

bool scene_assimp_may_be_collada(const struct scene_import *import)
{
    const char *const ending = import->ending;
    return ending[0] == 0 || is_zae(import) || strcasecmp(ending, "dae") == 0 ||
           strcasecmp(ending, "xml") == 0;
}

char *scene_assimp_collada(struct scene_import *import, size_t *size)
{
    const char *problem = NULL;
    char *text = scene_assimp_may_be_collada(import)
                     ? scene_import_read_bytes(import->model.path, size, &problem)
                     : NULL;
    if (text != NULL && is_zae(import) && strncmp(text, "PK", 2) == 0) {
        free(text);
        text = scene_assimp_read_zae(import, size);
    }
    if (text == NULL || strstr(text, "<COLLADA") == NULL) {
        free(text);
        return NULL;
    }
    scene_assimp_collapse_texts(text, *size);
    scene_assimp_rename_convex(text, *size);
    scene_assimp_check_indices(import, text, *size);
    text = scene_assimp_write_effects(import, scene_assimp_write_samplers(import, text, size), size);
    scene_assimp_number_sets(text, *size);
    text = scene_assimp_write_cameras(import, scene_assimp_name_images(text, size), size);
    return scene_assimp_write_matrices(import, text, size);
}

char *scene_assimp_dxf(struct scene_import *import, size_t *size)
{
    static const char binary[] = "AutoCAD Binary DXF";
    const char *problem = NULL;
    const bool is_dxf = strcasecmp(import->ending, "dxf") == 0;
    char *const text = is_dxf ? scene_import_read_bytes(import->model.path, size, &problem) : NULL;
    if (text == NULL || strncmp(text, binary, sizeof binary - 1) == 0) {
        free(text);
        return NULL;
    }
    char *const colored = scene_assimp_write_dxf_colors(import, text, size);
    return scene_assimp_insert_blocks(import, scene_assimp_flatten_dxf(import, colored, size), size);
}

// Open bytes. Return NULL if there are none.
static struct aiFile *open_memory(const char *bytes, size_t size)
{
    struct aiFile *const file = bytes == NULL ? NULL : malloc(sizeof *file);
    struct memory *const memory = file == NULL ? NULL : malloc(sizeof *memory);
    if (memory == NULL) {
        free(file);
        return NULL;
    }
    *memory = (struct memory){.bytes = bytes, .size = size};
    *file = (struct aiFile){.ReadProc = read_memory,
                            .WriteProc = write_nothing,
                            .TellProc = tell_memory,
                            .FileSizeProc = size_of_memory,
                            .SeekProc = seek_memory,
                            .FlushProc = flush,
                            .UserData = (aiUserData)(void *)memory};
    return file;
}

// Open the model in another form than its file has. Return NULL if assimp reads the file as it is.
static struct aiFile *open_model(struct scene_assimp_source *source)
{
    if (source->exact->bytes != NULL) {
        return open_memory(source->exact->bytes, source->exact->size);
    }
    if (!source->is_looked_at) {
        char *changed = scene_assimp_collada(source->import, &source->changed_size);
        changed = changed != NULL ? changed : scene_assimp_dxf(source->import, &source->changed_size);
        changed = changed != NULL ? changed : scene_assimp_fbx(source->import, &source->changed_size);
        changed = changed != NULL ? changed
                                  : scene_assimp_x3d(source->import, source->unknowns, &source->changed_size);
        changed = changed != NULL ? changed : scene_assimp_3ds(source->import, &source->changed_size);
        source->changed = changed;
        source->is_looked_at = true;
    }
    return open_memory(source->changed, source->changed_size);
}

static void close_memory(struct aiFile *file)
{
    free(memory_of(file));
    free(file);
}

static struct aiFile *open_file(struct aiFileIO *files, const char *path, const char *mode)
{
    struct scene_assimp_source *const source = (void *)files->UserData;
    struct scene_import *const import = source->import;
    const bool is_model = strcmp(path, import->model.path) == 0;
    const bool may_read = mode[0] == 'r' && (is_model || scene_import_within(import, path));
    struct aiFile *const changed = is_model && may_read ? open_model(source) : NULL;
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

struct aiFileIO scene_assimp_files(struct scene_assimp_source *source)
{
    return (struct aiFileIO){
        .OpenProc = open_file, .CloseProc = close_file, .UserData = (aiUserData)(void *)source};
}
