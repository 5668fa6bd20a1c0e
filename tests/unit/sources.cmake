# SPDX-License-Identifier: MIT
# What unit tests are made of beside their own file; tests/windows makes some of them too.

# These look into scene/ as well; those compare textures with a model of them.
set(scene_tests test_elementary test_import_progress test_work_outputs test_model test_import test_import_bad test_scene test_camera test_light test_shadow test_panorama test_layers test_ground test_transparency
  test_animation test_image_reduce test_gltf_extensions test_ktx2 test_3mf test_stl test_obj test_point_clouds test_resources test_fbx)
set(tiny_tests test_scene test_work_outputs test_camera test_light test_shadow test_panorama test_layers test_ground test_transparency)
set(texture_tests test_texture test_sample test_sample_compare test_texture_kinds test_anisotropy)
set(kind_tests test_texture_kinds test_anisotropy)
set(texel_tests test_texel_formats)
# Those link system/.
set(system_tests test_child)

# Adds what a test looks into, and the models of textures that it compares with.
function(rhw_unit_models name)
  if(name IN_LIST system_tests)
    target_link_libraries(${name} PRIVATE rhw_system)
  endif()
  if(name IN_LIST texture_tests)
    target_sources(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/harness/texture_model.c)
  endif()
  if(name IN_LIST texel_tests)
    target_sources(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/harness/texel_model.c)
  endif()
  if(name IN_LIST kind_tests)
    target_sources(${name} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/harness/kind_model.c)
  endif()
endfunction()
