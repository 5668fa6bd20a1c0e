// SPDX-License-Identifier: MIT
// IFC files.
#include "model_files.h"

// What has no material in an IFC is as light as in other formats.
static void test_no_materials(void **state)
{
    (void)state;
    struct scene_model *const model =
        load_text("m.ifc", "ISO-10303-21;\n"
                           "HEADER;\n"
                           "FILE_DESCRIPTION((''),'2;1');\n"
                           "FILE_NAME('','',(''),(''),'','','');\n"
                           "FILE_SCHEMA(('IFC2X3'));\n"
                           "ENDSEC;\n"
                           "DATA;\n"
                           "#1=IFCPERSON($,'a',$,$,$,$,$,$);\n"
                           "#2=IFCORGANIZATION($,'a',$,$,$);\n"
                           "#3=IFCPERSONANDORGANIZATION(#1,#2,$);\n"
                           "#4=IFCAPPLICATION(#2,'1','a','a');\n"
                           "#5=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n"
                           "#6=IFCCARTESIANPOINT((0.,0.,0.));\n"
                           "#7=IFCAXIS2PLACEMENT3D(#6,$,$);\n"
                           "#8=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#7,$);\n"
                           "#9=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
                           "#10=IFCUNITASSIGNMENT((#9));\n"
                           "#11=IFCPROJECT('p',#5,'p',$,$,$,$,(#8),#10);\n"
                           "#12=IFCLOCALPLACEMENT($,#7);\n"
                           "#13=IFCBUILDING('b',#5,'b',$,$,#12,$,$,.ELEMENT.,$,$,$);\n"
                           "#14=IFCRELAGGREGATES('a',#5,$,$,#11,(#13));\n"
                           "#15=IFCCARTESIANPOINT((1.,0.,0.));\n"
                           "#16=IFCCARTESIANPOINT((0.,1.,0.));\n"
                           "#17=IFCPOLYLOOP((#6,#15,#16));\n"
                           "#18=IFCFACEOUTERBOUND(#17,.T.);\n"
                           "#19=IFCFACE((#18));\n"
                           "#20=IFCOPENSHELL((#19));\n"
                           "#21=IFCSHELLBASEDSURFACEMODEL((#20));\n"
                           "#22=IFCSHAPEREPRESENTATION(#8,'Body','SurfaceModel',(#21));\n"
                           "#23=IFCPRODUCTDEFINITIONSHAPE($,$,(#22));\n"
                           "#24=IFCBUILDINGELEMENTPROXY('e',#5,'e',$,$,#12,#23,$,$);\n"
                           "#25=IFCRELCONTAINEDINSPATIALSTRUCTURE('c',#5,$,$,(#24),#13);\n"
                           "ENDSEC;\n"
                           "END-ISO-10303-21;\n");
    assert_int_equal(model->triangles_drawn, 1);
    assert_floats(model->materials[model->meshes[0].material].base_color,
                  (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_no_materials),
};

const struct unit_tests test_ifc = UNIT_TESTS(tests, make_directory, remove_directory);
