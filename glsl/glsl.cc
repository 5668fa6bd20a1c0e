// SPDX-License-Identifier: MIT
// Calls glslang. Its exceptions are those of memory.
#include "glsl_here.h"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <vector>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "glsl_log.h"
#include "glsl_macro.h"

// What glslang does by SPIRV-Tools where it is asked to validate, optimize or print. Nobody asks here, and 5 MB of
// optimizer stay out of programs. They are weak, so that a version of glslang that declares others takes its own.
namespace glslang {

using Words = std::vector<unsigned>;

__attribute__((weak)) void SpirvToolsDisassemble(std::ostream &, const Words &)
{
}
__attribute__((weak)) void SpirvToolsValidate(const TIntermediate &, Words &, spv::SpvBuildLogger *, bool)
{
}
__attribute__((weak)) void SpirvToolsTransform(const TIntermediate &, Words &, spv::SpvBuildLogger *,
                                               const SpvOptions *)
{
}
__attribute__((weak)) void SpirvToolsStripDebugInfo(const TIntermediate &, Words &, spv::SpvBuildLogger *)
{
}

} // namespace glslang

namespace {

// Asks the caller for what a text includes.
class Includer : public glslang::TShader::Includer {
  public:
    Includer(const glsl_options &given, std::set<std::string> &found) : options(given), files(found)
    {
    }

    IncludeResult *includeLocal(const char *header, const char *includer, size_t depth) override
    {
        return include(header, includer, depth, false);
    }

    // A name in quotes comes here when includeLocal, which looks in both manners, has refused it.
    IncludeResult *includeSystem(const char *header, const char *includer, size_t depth) override
    {
        return header == failed ? refuse(header, message) : include(header, includer, depth, true);
    }

    void releaseInclude(IncludeResult *result) override
    {
        if (result != nullptr) {
            std::free(result->userData);
            delete result;
        }
    }

  private:
    IncludeResult *refuse(const std::string &header, const std::string &problem)
    {
        failed = header;
        message = problem;
        return new IncludeResult("", message.c_str(), message.size(), nullptr);
    }

    IncludeResult *include(const char *header, const char *includer, size_t depth, bool is_system)
    {
        if (options.include == nullptr) {
            return refuse(header, "this text has no file to include from");
        }
        if (depth > GLSL_MAX_INCLUDE_DEPTH) {
            return refuse(header, "more than " + std::to_string(int{GLSL_MAX_INCLUDE_DEPTH}) +
                                      " files include each other");
        }
        glsl_include request = {};
        request.header = header;
        request.includer = includer;
        request.is_system = is_system;
        const char *const wrong = options.include(options.user, &request);
        if (wrong != nullptr) {
            return refuse(header, wrong);
        }
        const std::string name = request.name;
        std::free(request.name);
        files.insert(name);
        return new IncludeResult(name, request.text, request.size, request.text);
    }

    const glsl_options &options;
    std::set<std::string> &files; // names of what was included
    std::string failed, message;
};

EShLanguage language_of(rhw_shader_stage stage)
{
    return stage == RHW_SHADER_VERTEX     ? EShLangVertex
           : stage == RHW_SHADER_FRAGMENT ? EShLangFragment
                                          : EShLangCompute;
}

// What becomes of a text.
struct Translation {
    std::vector<unsigned> words;
    std::string log; // what glslang says
    std::set<std::string> files;
};

// Parse, link and generate. Return whether there is code.
bool translate(EShLanguage stage, const char *text, int size, const char *name, const char *preamble,
               const glsl_options &options, bool is_relaxed, Translation &made)
{
    const EShMessages messages =
        static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors |
                                 (options.has_lines ? EShMsgDebugInfo : 0));
    glslang::TShader shader(stage);
    shader.setStringsWithLengthsAndNames(&text, &size, &name, 1);
    shader.setPreamble(preamble);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    if (is_relaxed) {
        shader.setEnvInputVulkanRulesRelaxed();
        shader.setAutoMapBindings(true);
        shader.setAutoMapLocations(true);
    }
    made = Translation();
    Includer includer(options, made.files);
    const bool parsed =
        shader.parse(GetDefaultResources(), 450, ECoreProfile, false, false, messages, includer);
    made.log = shader.getInfoLog();
    if (!parsed) {
        return false;
    }
    glslang::TProgram program;
    program.addShader(&shader);
    const bool linked = program.link(messages) && (!is_relaxed || program.mapIO());
    made.log += program.getInfoLog();
    const glslang::TIntermediate *const intermediate = program.getIntermediate(stage);
    if (!linked || intermediate == nullptr) {
        return false;
    }
    spv::SpvBuildLogger logger;
    glslang::SpvOptions spirv;
    spirv.disableOptimizer = true;
    spirv.generateDebugInfo = options.has_lines;
    glslang::GlslangToSpv(*intermediate, made.words, &logger, &spirv);
    made.log += logger.getAllMessages();
    return !made.words.empty();
}

// glslang's own tables, which every thread and child shares. Those of functions are made for the first text.
class Process {
  public:
    Process()
    {
        glslang::InitializeProcess();
        const glsl_options nothing = {};
        Translation translation;
        const char text[] = "void main() {}";
        translate(EShLangFragment, text, sizeof text - 1, "", "", nothing, false, translation);
    }
    ~Process()
    {
        glslang::FinalizeProcess();
    }
};

// Return names by malloc, a line each. NULL: memory is out.
char *lines_of(const std::set<std::string> &names)
{
    std::string lines;
    for (const std::string &name : names) {
        lines += name + '\n';
    }
    return strdup(lines.c_str());
}

bool out_of_memory(const char *name, char *message, size_t message_size)
{
    glsl_log_first((std::string(name) + ": memory is out").c_str(), message, message_size);
    return false;
}

} // namespace

bool glsl_is_there(void)
{
    return true;
}

bool glsl_prepare(void)
try {
    static const Process process;
    (void)process;
    return true;
} catch (const std::bad_alloc &) {
    return false;
}

bool glsl_compile_here(enum rhw_shader_stage stage, const char *text, size_t size, const char *name,
                       const struct glsl_options *options, struct glsl_code *code, char *message,
                       size_t message_size)
try {
    *code = glsl_code{};
    if (size > GLSL_MAX_TEXT_SIZE) {
        glsl_log_first((std::string(name) + ": the text is larger than 16 MiB").c_str(), message,
                       message_size);
        return false;
    }
    if (!glsl_macros_check(options, message, message_size)) {
        return false;
    }
    const std::unique_ptr<char, void (*)(void *)> preamble(glsl_macros_print(options), std::free);
    if (!preamble) {
        return out_of_memory(name, message, message_size);
    }
    Translation translation;
    const EShLanguage language = language_of(stage);
    const int length = static_cast<int>(size);
    bool made = translate(language, text, length, name, preamble.get(), *options, false, translation);
    if (!made && options->is_relaxed) {
        made = translate(language, text, length, name, preamble.get(), *options, true, translation);
        code->is_relaxed = made;
    }
    code->log = glsl_log_lines(translation.log.c_str(), name);
    code->files = lines_of(translation.files);
    if (code->log == nullptr || code->files == nullptr) {
        return out_of_memory(name, message, message_size);
    }
    if (!made) {
        glsl_log_first(code->log, message, message_size);
        return false;
    }
    code->size = translation.words.size() * sizeof(uint32_t);
    code->words = static_cast<uint32_t *>(std::malloc(code->size));
    if (code->words == nullptr) {
        code->size = 0;
        return out_of_memory(name, message, message_size);
    }
    std::memcpy(code->words, translation.words.data(), code->size);
    return true;
} catch (const std::bad_alloc &) {
    return out_of_memory(name, message, message_size);
}

void glsl_code_free(struct glsl_code *code)
{
    std::free(code->words);
    std::free(code->log);
    std::free(code->files);
    *code = glsl_code{};
}
