// SPDX-License-Identifier: MIT
// A Vulkan layer that tells what a program asks of a driver: it counts lines of text, one for each call, each kind of
// image, pass, descriptor or draw, and each feature and extension that a device is created with. At the end it writes
// them sorted, to the file VULKAN_COUNT_FILE or else to stderr; modules of SPIR-V go into the folder VULKAN_COUNT_MODULES
// where that is set. With VULKAN_COUNT_LEAST=1 the driver below seems to be one of Vulkan 1.1 without extensions, with few
// features: what a program does then is what such a driver has to serve. The layer knows one device at a time.
#include <inttypes.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

enum { SLOTS = 1 << 16, SET_ENTRIES = 64, BOUND_SETS = 8, ATTACHMENTS = 24, VERTEX_BUFFERS = 32 };

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

// Lines ----------------------------------------------------------------------------------------------

static struct line {
    char *text;
    uint64_t count;
} lines[SLOTS];

static uint64_t hash_of(const void *bytes, size_t size)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    }
    return hash;
}

static void add_line(const char *text, uint64_t amount)
{
    const size_t length = strlen(text) + 1;
    pthread_mutex_lock(&lock);
    for (uint64_t i = hash_of(text, length), tries = 0; tries < SLOTS; i++, tries++) {
        struct line *const line = &lines[i % SLOTS];
        if (!line->text && (line->text = malloc(length))) {
            memcpy(line->text, text, length);
        }
        if (line->text && strcmp(line->text, text) == 0) {
            line->count += amount;
            break;
        }
    }
    pthread_mutex_unlock(&lock);
}

__attribute__((format(printf, 1, 2))) static void note(const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    add_line(text, 1);
}

static int compare_lines(const void *a, const void *b)
{
    const struct line *const left = a, *const right = b;
    return left->text && right->text ? strcmp(left->text, right->text) : !left->text - !right->text;
}

__attribute__((destructor)) static void write_lines(void)
{
    static struct line sorted[SLOTS];
    const char *const name = getenv("VULKAN_COUNT_FILE");
    FILE *const file = name ? fopen(name, "w") : stderr;
    memcpy(sorted, lines, sizeof sorted);
    qsort(sorted, SLOTS, sizeof *sorted, compare_lines);
    for (const struct line *line = sorted; file && line < sorted + SLOTS && line->text; line++) {
        fprintf(file, "%10" PRIu64 "  %s\n", line->count, line->text);
    }
    if (file && name) {
        fclose(file);
    }
}

// Append to a line that is being made.
__attribute__((format(printf, 2, 3))) static void append(char text[4096], const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, 4096 - used, format, arguments);
    va_end(arguments);
}

#include "names.inc"

// What is remembered of handles ------------------------------------------------------------------------

// Of a view its image, of a pass its attachments' count, of a set what was written, of a command buffer what is bound.
struct memory {
    uint64_t handle, image;
    bool in_pass;
    uint32_t count, attachment_count, vertex_count;
    struct {
        VkDescriptorType type;
        uint64_t object;
    } entries[SET_ENTRIES];
    uint64_t sets[BOUND_SETS], attachments[ATTACHMENTS], vertices[VERTEX_BUFFERS];
};

static struct memory *memories[SLOTS];

static struct memory *memory_of(uint64_t handle)
{
    struct memory *found = NULL;
    pthread_mutex_lock(&lock);
    for (uint64_t i = hash_of(&handle, sizeof handle), tries = 0; tries < SLOTS && !found; i++, tries++) {
        struct memory **const slot = &memories[i % SLOTS];
        if (!*slot && (*slot = calloc(1, sizeof **slot))) {
            (*slot)->handle = handle;
        }
        found = *slot && (*slot)->handle == handle ? *slot : NULL;
    }
    pthread_mutex_unlock(&lock);
    if (!found) {
        abort(); // a program of so many handles wants larger tables
    }
    return found;
}

#define HANDLE(handle) ((uint64_t)(uintptr_t)(handle))

// Objects ----------------------------------------------------------------------------------------------

static void before_vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo *info,
                                        const VkAllocationCallbacks *allocator, VkShaderModule *module)
{
    (void)device, (void)allocator, (void)module;
    const char *const folder = getenv("VULKAN_COUNT_MODULES");
    char name[4096];
    snprintf(name, sizeof name, "%s/%016" PRIx64 ".spv", folder ? folder : "",
             hash_of(info->pCode, info->codeSize));
    FILE *const file = folder ? fopen(name, "wb") : NULL;
    if (file) {
        fwrite(info->pCode, 1, info->codeSize, file);
        fclose(file);
    }
    for (size_t i = 5; i < info->codeSize / 4 && info->pCode[i] >> 16; i += info->pCode[i] >> 16) {
        if ((info->pCode[i] & 0xffff) == 17) {
            note("SPIR-V capability %" PRIu32, info->pCode[i + 1]);
        } else if ((info->pCode[i] & 0xffff) == 10 || (info->pCode[i] & 0xffff) == 11) {
            note("SPIR-V uses %s", (const char *)&info->pCode[i + ((info->pCode[i] & 0xffff) == 10 ? 1 : 2)]);
        }
    }
}

static void before_vkCreateImage(VkDevice device, const VkImageCreateInfo *info,
                                 const VkAllocationCallbacks *allocator, VkImage *image)
{
    (void)device, (void)allocator, (void)image;
    note("image %uD %s%s samples %u usage 0x%x flags 0x%x %s%s", (unsigned)info->imageType + 1,
         name_of_VkFormat((int)info->format), info->tiling ? " linear" : "", (unsigned)info->samples,
         info->usage, info->flags, info->mipLevels > 1 ? "levels " : "",
         info->arrayLayers > 1 ? "layers" : "");
}

static void after_vkCreateImageView(VkDevice device, const VkImageViewCreateInfo *info,
                                    const VkAllocationCallbacks *allocator, VkImageView *view)
{
    (void)device, (void)allocator;
    const VkComponentMapping c = info->components;
    const bool same = (!c.r || c.r == VK_COMPONENT_SWIZZLE_R) && (!c.g || c.g == VK_COMPONENT_SWIZZLE_G) &&
                      (!c.b || c.b == VK_COMPONENT_SWIZZLE_B) && (!c.a || c.a == VK_COMPONENT_SWIZZLE_A);
    note("view %s %s aspect 0x%x%s", name_of_VkImageViewType((int)info->viewType),
         name_of_VkFormat((int)info->format), info->subresourceRange.aspectMask, same ? "" : " swizzled");
    memory_of(HANDLE(*view))->image = HANDLE(info->image);
}

static void before_vkCreateBuffer(VkDevice device, const VkBufferCreateInfo *info,
                                  const VkAllocationCallbacks *allocator, VkBuffer *buffer)
{
    (void)device, (void)allocator, (void)buffer;
    note("buffer usage 0x%x flags 0x%x", info->usage, info->flags);
}

static void before_vkCreateBufferView(VkDevice device, const VkBufferViewCreateInfo *info,
                                      const VkAllocationCallbacks *allocator, VkBufferView *view)
{
    (void)device, (void)allocator, (void)view;
    note("buffer view %s", name_of_VkFormat((int)info->format));
}

static void before_vkCreateSampler(VkDevice device, const VkSamplerCreateInfo *info,
                                   const VkAllocationCallbacks *allocator, VkSampler *sampler)
{
    (void)device, (void)allocator, (void)sampler;
    note("sampler min %d mag %d mip %d wrap %d %d %d anisotropy %.0f compare %d border %d unnormalized %u",
         (int)info->minFilter, (int)info->magFilter, (int)info->mipmapMode, (int)info->addressModeU,
         (int)info->addressModeV, (int)info->addressModeW,
         info->anisotropyEnable ? (double)info->maxAnisotropy : 0,
         info->compareEnable ? (int)info->compareOp : -1, (int)info->borderColor,
         info->unnormalizedCoordinates);
}

static void before_vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo *info,
                                    const VkAllocationCallbacks *allocator, VkDeviceMemory *memory)
{
    (void)device, (void)allocator, (void)memory;
    add_line("bytes allocated", info->allocationSize);
    for (const VkBaseInStructure *next_info = info->pNext; next_info; next_info = next_info->pNext) {
        note("allocation with %s", name_of_VkStructureType((int)next_info->sType));
    }
}

static void before_vkCreateDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo *info,
                                               const VkAllocationCallbacks *allocator,
                                               VkDescriptorSetLayout *layout)
{
    (void)device, (void)allocator, (void)layout;
    for (uint32_t i = 0; i < info->bindingCount; i++) {
        const VkDescriptorSetLayoutBinding *const binding = &info->pBindings[i];
        note("layout binding %s count %s%s", name_of_VkDescriptorType((int)binding->descriptorType),
             binding->descriptorCount > 1 ? "> 1"
             : binding->descriptorCount   ? "1"
                                          : "0",
             binding->pImmutableSamplers ? " immutable samplers" : "");
    }
}

static void before_vkCreateRenderPass(VkDevice device, const VkRenderPassCreateInfo *info,
                                      const VkAllocationCallbacks *allocator, VkRenderPass *pass)
{
    (void)device, (void)allocator, (void)pass;
    char text[4096] = "";
    append(text, "render pass: %u subpasses", info->subpassCount);
    for (uint32_t i = 0; i < info->attachmentCount; i++) {
        const VkAttachmentDescription *const a = &info->pAttachments[i];
        append(text, "; %s samples %u %s %s", name_of_VkFormat((int)a->format), (unsigned)a->samples,
               name_of_VkAttachmentLoadOp((int)a->loadOp), name_of_VkAttachmentStoreOp((int)a->storeOp));
    }
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        const VkSubpassDescription *const s = &info->pSubpasses[i];
        append(text, "; subpass %u colors%s%s inputs %u", s->colorAttachmentCount,
               s->pResolveAttachments ? " resolved" : "", s->pDepthStencilAttachment ? " depth" : "",
               s->inputAttachmentCount);
        for (uint32_t j = 0; j < s->colorAttachmentCount; j++) {
            note("color attachment in layout %s", name_of_VkImageLayout((int)s->pColorAttachments[j].layout));
        }
        if (s->pDepthStencilAttachment) {
            note("depth attachment in layout %s",
                 name_of_VkImageLayout((int)s->pDepthStencilAttachment->layout));
        }
    }
    for (uint32_t i = 0; i < info->dependencyCount; i++) {
        const VkSubpassDependency *const d = &info->pDependencies[i];
        append(text, d->srcSubpass == d->dstSubpass ? "; self-dependency" : "");
    }
    add_line(text, 1);
}

static void append_stages(char text[4096], const VkGraphicsPipelineCreateInfo *info)
{
    for (uint32_t i = 0; i < info->stageCount; i++) {
        append(text, " stage 0x%x%s", (unsigned)info->pStages[i].stage,
               info->pStages[i].pSpecializationInfo ? " specialized" : "");
    }
    for (const VkBaseInStructure *chain = info->pNext; chain; chain = chain->pNext) {
        append(text, " with %s", name_of_VkStructureType((int)chain->sType));
    }
}

static void note_pipeline(const VkGraphicsPipelineCreateInfo *info)
{
    char text[4096] = "pipeline";
    const VkPipelineVertexInputStateCreateInfo *const vertex = info->pVertexInputState;
    const VkPipelineRasterizationStateCreateInfo *const raster = info->pRasterizationState;
    const VkPipelineColorBlendStateCreateInfo *const blend = info->pColorBlendState;
    append_stages(text, info);
    if (info->pInputAssemblyState) {
        append(text, " %s%s", name_of_VkPrimitiveTopology((int)info->pInputAssemblyState->topology),
               info->pInputAssemblyState->primitiveRestartEnable ? " restart" : "");
    }
    if (raster) {
        append(text, "%s%s%s", raster->depthBiasEnable ? " bias" : "",
               raster->depthClampEnable ? " clamp" : "", raster->polygonMode ? " not filled" : "");
    }
    if (info->pMultisampleState) {
        append(text, " samples %u%s%s", (unsigned)info->pMultisampleState->rasterizationSamples,
               info->pMultisampleState->sampleShadingEnable ? " sample shading" : "",
               info->pMultisampleState->alphaToCoverageEnable ? " alpha to coverage" : "");
    }
    for (uint32_t i = 0; blend && i < blend->attachmentCount; i++) {
        append(text, blend->pAttachments[i].blendEnable ? " blended" : " opaque");
    }
    for (uint32_t i = 0; info->pDynamicState && i < info->pDynamicState->dynamicStateCount; i++) {
        note("dynamic state %s", name_of_VkDynamicState((int)info->pDynamicState->pDynamicStates[i]));
    }
    for (uint32_t i = 0; vertex && i < vertex->vertexAttributeDescriptionCount; i++) {
        note("vertex attribute %s", name_of_VkFormat((int)vertex->pVertexAttributeDescriptions[i].format));
    }
    add_line(text, 1);
}

static void before_vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                             const VkGraphicsPipelineCreateInfo *infos,
                                             const VkAllocationCallbacks *allocator, VkPipeline *pipelines)
{
    (void)device, (void)cache, (void)allocator, (void)pipelines;
    for (uint32_t i = 0; i < count; i++) {
        note_pipeline(&infos[i]);
    }
}

static void before_vkUpdateDescriptorSets(VkDevice device, uint32_t count, const VkWriteDescriptorSet *writes,
                                          uint32_t copies, const VkCopyDescriptorSet *copied)
{
    (void)device, (void)copied;
    add_line("descriptor copies", copies);
    for (uint32_t i = 0; i < count; i++) {
        const VkWriteDescriptorSet *const write = &writes[i];
        struct memory *const set = memory_of(HANDLE(write->dstSet));
        for (uint32_t j = 0; j < write->descriptorCount; j++) {
            const bool is_buffer = write->descriptorType >= VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER &&
                                   write->descriptorType <= VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
            const bool is_view = write->descriptorType <= VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            note("descriptor written: %s%s%s", name_of_VkDescriptorType((int)write->descriptorType),
                 is_view && write->descriptorType ? " in layout " : "",
                 is_view && write->descriptorType
                     ? name_of_VkImageLayout((int)write->pImageInfo[j].imageLayout)
                     : "");
            set->entries[set->count % SET_ENTRIES].type = write->descriptorType;
            set->entries[set->count++ % SET_ENTRIES].object =
                is_buffer ? HANDLE(write->pBufferInfo[j].buffer)
                : is_view ? memory_of(HANDLE(write->pImageInfo[j].imageView))->image
                          : 0;
        }
    }
}

static void after_vkAllocateDescriptorSets(VkDevice device, const VkDescriptorSetAllocateInfo *info,
                                           VkDescriptorSet *sets)
{
    (void)device;
    for (uint32_t i = 0; i < info->descriptorSetCount; i++) {
        memory_of(HANDLE(sets[i]))->count = 0;
    }
}

static void after_vkCreateFramebuffer(VkDevice device, const VkFramebufferCreateInfo *info,
                                      const VkAllocationCallbacks *allocator, VkFramebuffer *framebuffer)
{
    (void)device, (void)allocator;
    struct memory *const memory = memory_of(HANDLE(*framebuffer));
    memory->attachment_count = 0;
    for (uint32_t i = 0; i < info->attachmentCount && i < ATTACHMENTS && info->pAttachments; i++) {
        memory->attachments[memory->attachment_count++] = memory_of(HANDLE(info->pAttachments[i]))->image;
    }
}

// Commands ---------------------------------------------------------------------------------------------

static void before_vkBeginCommandBuffer(VkCommandBuffer buffer, const VkCommandBufferBeginInfo *info)
{
    (void)info;
    struct memory *const commands = memory_of(HANDLE(buffer));
    const uint64_t handle = commands->handle;
    memset(commands, 0, sizeof *commands);
    commands->handle = handle;
}

static void before_vkCmdBeginRenderPass(VkCommandBuffer buffer, const VkRenderPassBeginInfo *info,
                                        VkSubpassContents contents)
{
    struct memory *const commands = memory_of(HANDLE(buffer));
    const struct memory *const framebuffer = memory_of(HANDLE(info->framebuffer));
    commands->in_pass = true;
    commands->attachment_count = framebuffer->attachment_count;
    memcpy(commands->attachments, framebuffer->attachments, sizeof commands->attachments);
    note("pass begun%s", contents ? " for secondary command buffers" : "");
}

static void before_vkCmdEndRenderPass(VkCommandBuffer buffer)
{
    memory_of(HANDLE(buffer))->in_pass = false;
}

static void before_vkCmdBeginRendering(VkCommandBuffer buffer, const VkRenderingInfo *info)
{
    (void)info;
    memory_of(HANDLE(buffer))->in_pass = true;
    note("pass begun without render pass object");
}

static void before_vkCmdEndRendering(VkCommandBuffer buffer)
{
    memory_of(HANDLE(buffer))->in_pass = false;
}

static void before_vkCmdPipelineBarrier(VkCommandBuffer buffer, VkPipelineStageFlags from,
                                        VkPipelineStageFlags to, VkDependencyFlags flags, uint32_t count,
                                        const VkMemoryBarrier *memory, uint32_t buffer_count,
                                        const VkBufferMemoryBarrier *buffers, uint32_t image_count,
                                        const VkImageMemoryBarrier *images)
{
    (void)from, (void)to, (void)flags, (void)count, (void)memory, (void)buffer_count, (void)buffers;
    note("barrier %s a pass", memory_of(HANDLE(buffer))->in_pass ? "inside" : "outside of");
    for (uint32_t i = 0; i < image_count; i++) {
        note("image barrier to layout %s", name_of_VkImageLayout((int)images[i].newLayout));
    }
}

static void before_vkCmdBindDescriptorSets(VkCommandBuffer buffer, VkPipelineBindPoint point,
                                           VkPipelineLayout layout, uint32_t first, uint32_t count,
                                           const VkDescriptorSet *sets, uint32_t offset_count,
                                           const uint32_t *offsets)
{
    (void)layout, (void)offsets;
    struct memory *const commands = memory_of(HANDLE(buffer));
    for (uint32_t i = 0; i < count && first + i < BOUND_SETS; i++) {
        commands->sets[first + i] = HANDLE(sets[i]);
    }
    note("sets bound for %s%s", point == VK_PIPELINE_BIND_POINT_GRAPHICS ? "draws" : "dispatches",
         offset_count ? " with dynamic offsets" : "");
}

static void before_vkCmdBindVertexBuffers(VkCommandBuffer buffer, uint32_t first, uint32_t count,
                                          const VkBuffer *buffers, const VkDeviceSize *offsets)
{
    (void)offsets;
    struct memory *const commands = memory_of(HANDLE(buffer));
    for (uint32_t i = 0; i < count && first + i < VERTEX_BUFFERS; i++) {
        commands->vertices[first + i] = HANDLE(buffers[i]);
    }
}

static bool is_among(uint64_t handle, const uint64_t *handles, uint32_t count)
{
    for (uint32_t i = 0; handle && i < count; i++) {
        if (handles[i] == handle) {
            return true;
        }
    }
    return false;
}

// Tell of a draw what rules of other libraries forbid: images that are read and attached, bytes read and stored.
static void note_draw(VkCommandBuffer buffer, const char *kind)
{
    const struct memory *const commands = memory_of(HANDLE(buffer));
    note("draw%s", kind);
    for (uint32_t i = 0; i < BOUND_SETS; i++) {
        const struct memory *const set = memory_of(commands->sets[i]);
        for (uint32_t j = 0; commands->sets[i] && j < set->count && j < SET_ENTRIES; j++) {
            const VkDescriptorType type = set->entries[j].type;
            const uint64_t object = set->entries[j].object;
            if (is_among(object, commands->attachments, commands->attachment_count)) {
                note("draw with %s that is an attachment", name_of_VkDescriptorType((int)type));
            }
            if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
                type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC) {
                note("draw with storage buffer%s",
                     is_among(object, commands->vertices, VERTEX_BUFFERS) ? " of its vertices" : "");
            } else if (type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
                note("draw with storage image");
            }
        }
    }
}

static void before_vkCmdDraw(VkCommandBuffer buffer, uint32_t vertices, uint32_t instances, uint32_t first,
                             uint32_t first_instance)
{
    (void)vertices, (void)first;
    note_draw(buffer, instances > 1 ? " of instances" : first_instance ? " from another instance" : "");
}

static void before_vkCmdDrawIndexed(VkCommandBuffer buffer, uint32_t indices, uint32_t instances,
                                    uint32_t first, int32_t offset, uint32_t first_instance)
{
    (void)indices, (void)first, (void)offset;
    note_draw(buffer, instances > 1 ? " of instances" : first_instance ? " from another instance" : "");
}

static void before_vkCmdCopyBuffer(VkCommandBuffer buffer, VkBuffer from, VkBuffer to, uint32_t count,
                                   const VkBufferCopy *regions)
{
    (void)buffer, (void)from, (void)to;
    for (uint32_t i = 0; i < count; i++) {
        add_line("bytes copied between buffers", regions[i].size);
    }
}

static void before_vkQueueSubmit(VkQueue queue, uint32_t count, const VkSubmitInfo *submits, VkFence fence)
{
    (void)queue, (void)fence;
    for (uint32_t i = 0; i < count; i++) {
        note("submitted batch of %u command buffers, waits %s, signals %s", submits[i].commandBufferCount,
             submits[i].waitSemaphoreCount ? "yes" : "no", submits[i].signalSemaphoreCount ? "yes" : "no");
        for (const VkBaseInStructure *chain = submits[i].pNext; chain; chain = chain->pNext) {
            note("submission with %s", name_of_VkStructureType((int)chain->sType));
        }
    }
}

static void before_vkCreateSemaphore(VkDevice device, const VkSemaphoreCreateInfo *info,
                                     const VkAllocationCallbacks *allocator, VkSemaphore *semaphore)
{
    (void)device, (void)allocator, (void)semaphore;
    note("semaphore%s", info->pNext ? " with a chain" : "");
}

static void before_vkCreateQueryPool(VkDevice device, const VkQueryPoolCreateInfo *info,
                                     const VkAllocationCallbacks *allocator, VkQueryPool *pool)
{
    (void)device, (void)allocator, (void)pool;
    note("query pool %s", name_of_VkQueryType((int)info->queryType));
}

#include "wrappers.inc"

// The chain of layers ------------------------------------------------------------------------------------

static PFN_vkGetInstanceProcAddr next_instance_address;
static PFN_vkGetDeviceProcAddr next_device_address;
static VkInstance instance_now;
static struct {
    PFN_vkGetPhysicalDeviceFeatures vkGetPhysicalDeviceFeatures;
    PFN_vkGetPhysicalDeviceFeatures2 vkGetPhysicalDeviceFeatures2;
    PFN_vkGetPhysicalDeviceProperties vkGetPhysicalDeviceProperties;
    PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2;
    PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties;
} next_instance;

// The link that the loader put into the chain of a create info. The structures of instance and device begin alike.
static void *link_of(const void *chain, VkStructureType type)
{
    for (const VkLayerInstanceCreateInfo *info = chain; info; info = info->pNext) {
        if (info->sType == type && info->function == VK_LAYER_LINK_INFO) {
            return (void *)(uintptr_t)info;
        }
    }
    return NULL;
}

#define NEXT(name) next_instance.name = (PFN_##name)next_instance_address(instance_now, #name)

static VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo *info,
                                                      const VkAllocationCallbacks *allocator,
                                                      VkInstance *instance)
{
    VkLayerInstanceCreateInfo *const link =
        link_of(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    const VkApplicationInfo *const application = info->pApplicationInfo;
    next_instance_address = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    note("instance of %s, engine %s, API %u.%u",
         application && application->pApplicationName ? application->pApplicationName : "-",
         application && application->pEngineName ? application->pEngineName : "-",
         application ? VK_VERSION_MAJOR(application->apiVersion) : 1,
         application ? VK_VERSION_MINOR(application->apiVersion) : 0);
    for (uint32_t i = 0; i < info->enabledExtensionCount; i++) {
        note("instance extension %s", info->ppEnabledExtensionNames[i]);
    }
    const PFN_vkCreateInstance create = (PFN_vkCreateInstance)next_instance_address(NULL, "vkCreateInstance");
    const VkResult result = create(info, allocator, instance);
    if (result == VK_SUCCESS) {
        instance_now = *instance;
        NEXT(vkGetPhysicalDeviceFeatures);
        NEXT(vkGetPhysicalDeviceFeatures2);
        NEXT(vkGetPhysicalDeviceProperties);
        NEXT(vkGetPhysicalDeviceProperties2);
        NEXT(vkEnumerateDeviceExtensionProperties);
    }
    return result;
}

static void note_features(int type, const VkBool32 *values)
{
    for (size_t i = 0; i < sizeof feature_names / sizeof *feature_names; i++) {
        for (int j = 0; feature_names[i].type == type && j < 64 && feature_names[i].names[j]; j++) {
            if (values[j]) {
                note("feature %s", feature_names[i].names[j]);
            }
        }
    }
}

static void note_device(const VkDeviceCreateInfo *info)
{
    note("device of %u queue families", info->queueCreateInfoCount);
    for (uint32_t i = 0; i < info->enabledExtensionCount; i++) {
        note("device extension %s", info->ppEnabledExtensionNames[i]);
    }
    if (info->pEnabledFeatures) {
        note_features(0, (const VkBool32 *)info->pEnabledFeatures);
    }
    for (const VkBaseInStructure *chain = info->pNext; chain; chain = chain->pNext) {
        const bool is_all = chain->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        note_features(is_all ? 0 : (int)chain->sType, (const VkBool32 *)(const void *)(chain + 1));
    }
}

static VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                                                    const VkAllocationCallbacks *allocator, VkDevice *device)
{
    VkLayerDeviceCreateInfo *const link = link_of(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    const PFN_vkGetInstanceProcAddr address = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    next_device_address = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const PFN_vkCreateDevice create = (PFN_vkCreateDevice)address(instance_now, "vkCreateDevice");
    const VkResult result = create(physical, info, allocator, device);
    note_device(info);
    for (size_t i = 0; i < sizeof wrappers / sizeof *wrappers && result == VK_SUCCESS; i++) {
        *wrappers[i].next = next_device_address(*device, wrappers[i].name);
    }
    return result;
}

// The least driver ---------------------------------------------------------------------------------------

// The features of a driver that programs of WebGPU accept.
static const char *const least_features[] = {
    "robustBufferAccess",
    "fullDrawIndexUint32",
    "imageCubeArray",
    "independentBlend",
    "sampleRateShading",
    "depthBiasClamp",
    "fragmentStoresAndAtomics",
    "textureCompressionBC",
    "samplerAnisotropy",
    "shaderUniformBufferArrayDynamicIndexing",
    "shaderSampledImageArrayDynamicIndexing",
    "shaderStorageBufferArrayDynamicIndexing",
    "shaderStorageImageArrayDynamicIndexing",
    "multiview",
};

static bool is_least(const char *feature)
{
    for (size_t i = 0; i < sizeof least_features / sizeof *least_features; i++) {
        if (strcmp(least_features[i], feature) == 0) {
            return true;
        }
    }
    return !getenv("VULKAN_COUNT_LEAST");
}

static void hide_features(int type, VkBool32 *values)
{
    for (size_t i = 0; i < sizeof feature_names / sizeof *feature_names; i++) {
        for (int j = 0; feature_names[i].type == type && j < 64 && feature_names[i].names[j]; j++) {
            values[j] = values[j] && is_least(feature_names[i].names[j]);
        }
    }
}

static VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice device, VkPhysicalDeviceFeatures *features)
{
    next_instance.vkGetPhysicalDeviceFeatures(device, features);
    hide_features(0, (VkBool32 *)features);
}

static VKAPI_ATTR void VKAPI_CALL get_features2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2 *features)
{
    next_instance.vkGetPhysicalDeviceFeatures2(device, features);
    hide_features(0, (VkBool32 *)&features->features);
    for (VkBaseOutStructure *chain = features->pNext; chain; chain = chain->pNext) {
        note("features asked for: %s", name_of_VkStructureType((int)chain->sType));
        hide_features((int)chain->sType, (VkBool32 *)(void *)(chain + 1));
    }
}

static VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                                 VkPhysicalDeviceProperties *properties)
{
    next_instance.vkGetPhysicalDeviceProperties(device, properties);
    properties->apiVersion = getenv("VULKAN_COUNT_LEAST") ? VK_API_VERSION_1_1 : properties->apiVersion;
}

static VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice device,
                                                  VkPhysicalDeviceProperties2 *properties)
{
    next_instance.vkGetPhysicalDeviceProperties2(device, properties);
    for (VkBaseOutStructure *chain = properties->pNext; chain; chain = chain->pNext) {
        note("properties asked for: %s", name_of_VkStructureType((int)chain->sType));
    }
    if (getenv("VULKAN_COUNT_LEAST")) {
        properties->properties.apiVersion = VK_API_VERSION_1_1;
    }
}

static VKAPI_ATTR VkResult VKAPI_CALL get_extensions(VkPhysicalDevice device, const char *layer,
                                                     uint32_t *count, VkExtensionProperties *properties)
{
    if (getenv("VULKAN_COUNT_LEAST")) {
        *count = 0;
        return VK_SUCCESS;
    }
    return next_instance.vkEnumerateDeviceExtensionProperties(device, layer, count, properties);
}

static PFN_vkVoidFunction own_function(const char *name);

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_address(VkDevice device, const char *name)
{
    const PFN_vkVoidFunction own = own_function(name);
    for (size_t i = 0; i < sizeof wrappers / sizeof *wrappers; i++) {
        if (strcmp(wrappers[i].name, name) == 0) {
            return *wrappers[i].next ? wrappers[i].function : NULL;
        }
    }
    return own ? own : next_device_address(device, name);
}

// Commands of a device are wrapped here, too: a program may call those that the loader exports.
static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_address(VkInstance instance, const char *name)
{
    const PFN_vkVoidFunction own = own_function(name);
    if (own) {
        return own;
    }
    const PFN_vkVoidFunction found = next_instance_address ? next_instance_address(instance, name) : NULL;
    for (size_t i = 0; found && i < sizeof wrappers / sizeof *wrappers; i++) {
        if (strcmp(wrappers[i].name, name) == 0) {
            return wrappers[i].function;
        }
    }
    return found;
}

static PFN_vkVoidFunction own_function(const char *name)
{
    static const struct {
        const char *name;
        PFN_vkVoidFunction function;
    } own[] = {
        {"vkGetInstanceProcAddr", (PFN_vkVoidFunction)get_instance_address},
        {"vkGetDeviceProcAddr", (PFN_vkVoidFunction)get_device_address},
        {"vkCreateInstance", (PFN_vkVoidFunction)create_instance},
        {"vkCreateDevice", (PFN_vkVoidFunction)create_device},
        {"vkGetPhysicalDeviceFeatures", (PFN_vkVoidFunction)get_features},
        {"vkGetPhysicalDeviceFeatures2", (PFN_vkVoidFunction)get_features2},
        {"vkGetPhysicalDeviceFeatures2KHR", (PFN_vkVoidFunction)get_features2},
        {"vkGetPhysicalDeviceProperties", (PFN_vkVoidFunction)get_properties},
        {"vkGetPhysicalDeviceProperties2", (PFN_vkVoidFunction)get_properties2},
        {"vkGetPhysicalDeviceProperties2KHR", (PFN_vkVoidFunction)get_properties2},
        {"vkEnumerateDeviceExtensionProperties", (PFN_vkVoidFunction)get_extensions},
    };
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        if (strcmp(own[i].name, name) == 0) {
            return own[i].function;
        }
    }
    return NULL;
}

VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *version)
{
    version->loaderLayerInterfaceVersion = CURRENT_LOADER_LAYER_INTERFACE_VERSION;
    version->pfnGetInstanceProcAddr = get_instance_address;
    version->pfnGetDeviceProcAddr = get_device_address;
    version->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}
