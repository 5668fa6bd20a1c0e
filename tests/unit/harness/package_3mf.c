// SPDX-License-Identifier: MIT
#include "package_3mf.h"

#include <stdio.h>
#include <string.h>

zipFile package_begin(const char *name)
{
    zipFile zip = zipOpen64(path_of(name), APPEND_STATUS_CREATE);
    assert_non_null(zip);
    return zip;
}

void package_add(zipFile zip, const char *name, const void *bytes, size_t size)
{
    const zip_fileinfo info = {.dosDate = 1};
    assert_int_equal(zipOpenNewFileInZip(zip, name, &info, NULL, 0, NULL, 0, NULL, Z_DEFLATED, 6), ZIP_OK);
    assert_int_equal(zipWriteInFileInZip(zip, bytes, (unsigned)size), ZIP_OK);
    assert_int_equal(zipCloseFileInZip(zip), ZIP_OK);
}

void package_add_text(zipFile zip, const char *name, const char *text)
{
    package_add(zip, name, text, strlen(text));
}

void package_add_relationships(zipFile zip)
{
    package_add_text(
        zip, "_rels/.rels",
        "<?xml version=\"1.0\"?><Relationships "
        "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
        "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>");
}

void package_add_model(zipFile zip, const char *part, const char *resources, const char *build)
{
    char text[32768];
    snprintf(text, sizeof text,
             "<?xml version=\"1.0\"?><model unit=\"millimeter\" "
             "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
             "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
             "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\">"
             "<metadata name=\"Title\">x<b/></metadata><resources>%s</resources><build>%s</build></model>",
             resources, build);
    package_add_text(zip, part, text);
}

void package_end(zipFile zip)
{
    assert_int_equal(zipClose(zip, NULL), ZIP_OK);
}

void package_write(const char *name, const char *resources, const char *build)
{
    zipFile zip = package_begin(name);
    package_add_relationships(zip);
    package_add_model(zip, "3D/3dmodel.model", resources, build);
    package_end(zip);
}

struct scene_model *package_load(const char *resources, const char *build)
{
    package_write("x.3mf", resources, build);
    return load("x.3mf");
}

const struct scene_mesh *mesh_of(const struct scene_model *model, uint32_t instance)
{
    assert_true(instance < model->instance_count);
    return &model->meshes[model->instances[instance].mesh];
}
