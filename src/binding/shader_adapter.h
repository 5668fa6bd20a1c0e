// SPDX-License-Identifier: MIT
// Functions that have the 8-lane form and call a shader function one at a time.
#ifndef RHW_SHADER_ADAPTER_H
#define RHW_SHADER_ADAPTER_H

#include "pipeline/pipeline.h"
#include "rhw/shader.h"

void rhw_vertex1_run(const struct rhw_pipeline_data *pipeline, struct rhw_vertex *groups, int count);
void rhw_fragment1_run(const struct rhw_pipeline_data *pipeline, struct rhw_fragment *groups, int count);

#endif
