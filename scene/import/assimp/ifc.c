// SPDX-License-Identifier: MIT
// The schema of an IFC, and the version of a Collada document. assimp 5.2.5 is made for IFC2X3: entities of later
// schemas that have another form there it refuses by details, or crashes. Of Collada before 1.4 it finds nothing.
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "assimp.h"
#include "file.h"

enum { HEAD = 16384 }; // bytes in which a header says its schema

// Return the name of a schema of IFC behind FILE_SCHEMA. Return NULL if there is none.
static const char *find_schema(const char *head)
{
    const char *place = strstr(head, "FILE_SCHEMA");
    const size_t length = place == NULL ? 0 : strcspn(place, ";");
    for (size_t i = 0; i + 3 < length; i++) {
        if (strncasecmp(place + i, "IFC", 3) == 0) {
            return place + i;
        }
    }
    return NULL;
}

// Return the version of a Collada document that assimp does not know. Return NULL if there is none.
static const char *find_version(const char *head)
{
    static const char attribute[] = " version=\"";
    const char *const tag = strstr(head, "<COLLADA");
    const char *const place = tag == NULL ? NULL : strstr(tag, attribute);
    const char *const version =
        place == NULL || place > tag + strcspn(tag, ">") ? NULL : place + strlen(attribute);
    return version != NULL && strncmp(version, "1.", 2) == 0 && version[2] < '4' ? version : NULL;
}

const char *scene_assimp_schema(struct scene_import *import)
{
    char head[HEAD + 1];
    const int descriptor = system_file_open_regular(import->model.path);
    FILE *const file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (file == NULL) {
        return "";
    }
    head[fread(head, 1, HEAD, file)] = 0;
    fclose(file);
    const bool is_exchange_file = strstr(head, "ISO-10303-21") != NULL;
    const char *const schema = is_exchange_file ? find_schema(head) : NULL, *const version =
                                                                                find_version(head);
    const bool is_known = schema == NULL || strncasecmp(schema, "IFC2X3", 6) == 0;
    if (is_known && version == NULL) {
        return "";
    }
    const char *const text = is_known ? version : schema;
    const char *const name = scene_import_string(import, text, strcspn(text, "'\" \t\r\n,);"));
    char why[96];
    snprintf(why, sizeof why, "; assimp knows %s, and this is %.32s",
             is_known ? "Collada 1.4 and 1.5" : "IFC2X3", name);
    return scene_import_string(import, why, sizeof why);
}
