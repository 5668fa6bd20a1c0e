#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Write what layer.c includes of the registry of Vulkan: names.inc, the names of values and features, and wrappers.inc,
a wrapper for each command of a device, which calls before_NAME and after_NAME of layer.c where these exist.
usage: wrappers.py vk.xml layer.c vulkan_core.h FOLDER
"""
import contextlib
import re
import sys
import xml.etree.ElementTree as tree

ENUMS = ['VkFormat', 'VkStructureType', 'VkImageLayout', 'VkDescriptorType', 'VkAttachmentLoadOp',
         'VkAttachmentStoreOp', 'VkPrimitiveTopology', 'VkDynamicState', 'VkImageViewType', 'VkQueryType']
OWN = {'vkGetDeviceProcAddr', 'vkCreateDevice'}  # layer.c has them itself
HANDLES = {'VkDevice', 'VkQueue', 'VkCommandBuffer'}


def text_of(element):
    return ' '.join(''.join(element.itertext()).split())


def is_for_vulkan(element):
    return 'vulkan' in element.get('api', 'vulkan').split(',')


def enum_names(root, name):
    """Values of an enumeration by number, those of extensions among them."""
    found = {}
    for block in root.findall(f'enums[@name="{name}"]/enum'):
        if block.get('value'):
            found.setdefault(int(block.get('value'), 0), block.get('name'))
    for holder in root.findall('feature') + root.findall('extensions/extension'):
        for enum in holder.findall(f'require/enum[@extends="{name}"]'):
            number = enum.get('extnumber', holder.get('number'))
            if enum.get('offset') and number:
                value = 1000000000 + (int(number) - 1) * 1000 + int(enum.get('offset'))
                found.setdefault(-value if enum.get('dir') else value, enum.get('name'))
            elif enum.get('value'):
                found.setdefault(int(enum.get('value'), 0), enum.get('name'))
    return found


def write_enums(root):
    for name in ENUMS:
        prefix = re.sub('([a-z])([A-Z])', r'\1_\2', name).upper() + '_'  # VK_FORMAT_ of VkFormat
        print(f'static const char *name_of_{name}(int value)\n{{\n    switch (value) {{')
        for value, word in sorted(enum_names(root, name).items()):
            print(f'    case {value}: return "{word.removeprefix(prefix).removeprefix("VK_")}";')
        print('    default: return "unknown";\n    }\n}\n')


def write_features(root):
    """The names of each structure of features, which are all VkBool32."""
    print('static const struct feature_names {\n    int type;\n    const char *names[64];\n} feature_names[] = {')
    for struct in root.findall('types/type[@category="struct"]'):
        members = [m for m in struct.findall('member') if is_for_vulkan(m)]
        extends = struct.get('structextends', '')
        if struct.get('name') != 'VkPhysicalDeviceFeatures' and 'VkDeviceCreateInfo' not in extends:
            continue
        names = [m.findtext('name') for m in members if m.findtext('type') == 'VkBool32']
        kind = members[0].get('values')
        value = {v: k for k, v in enum_names(root, 'VkStructureType').items()}.get(kind, 0)
        if names and len(names) == len(members) - (2 if kind else 0) and (value or not kind):
            quoted = ', '.join(f'"{name}"' for name in names)
            print(f'    {{{value}, {{{quoted}}}}},')
    print('};\n')


def commands_of(root):
    """Return type and parameters by name, aliases resolved."""
    found, aliases = {}, {}
    for command in root.findall('commands/command'):
        if command.get('alias'):
            aliases[command.get('name')] = command.get('alias')
        elif is_for_vulkan(command):
            parameters = [p for p in command.findall('param') if is_for_vulkan(p)]
            found[command.findtext('proto/name')] = (command.findtext('proto/type'), [text_of(p) for p in parameters],
                                                     [p.findtext('name') for p in parameters],
                                                     parameters[0].findtext('type'))
    for name, target in aliases.items():
        if target in found:
            found[name] = found[target]
    return found, aliases


def write_commands(root, hooks, header):
    commands, aliases = commands_of(root)
    chosen = sorted(name for name in commands
                    if commands[name][3] in HANDLES and name not in OWN and f' VKAPI_CALL {name}(' in header)
    print('static struct {')
    for name in chosen:
        print(f'    PFN_{name} {name};')
    print('} next;\n')
    for name in chosen:
        result, parameters, arguments, _ = commands[name]
        passed = ', '.join(arguments)
        base = aliases.get(name, name)
        print(f'static VKAPI_ATTR {result} VKAPI_CALL count_{name}({", ".join(parameters)})\n{{')
        print(f'    note("call {name}");')
        if f'before_{base}' in hooks:
            print(f'    before_{base}({passed});')
        print('    ' + ('' if result == 'void' else f'const {result} result = ') + f'next.{name}({passed});')
        if f'after_{base}' in hooks:
            print(f'    after_{base}({passed});')
        print(('' if result == 'void' else '    return result;\n') + '}\n')
    print('static const struct wrapper {\n    const char *name;\n    PFN_vkVoidFunction *next, function;\n} wrappers[] = {')
    for name in chosen:
        print(f'    {{"{name}", (PFN_vkVoidFunction *)&next.{name}, (PFN_vkVoidFunction)count_{name}}},')
    print('};')


def main():
    registry, layer, core, folder = sys.argv[1:]
    root = tree.parse(registry).getroot()
    with open(layer, encoding='utf-8') as text:
        hooks = set(re.findall(r'^static void ((?:before|after)_vk\w+)', text.read(), re.MULTILINE))
    with open(core, encoding='utf-8') as text:
        header = text.read()
    with open(f'{folder}/names.inc', 'w', encoding='utf-8') as out, contextlib.redirect_stdout(out):
        write_enums(root)
        write_features(root)
    with open(f'{folder}/wrappers.inc', 'w', encoding='utf-8') as out, contextlib.redirect_stdout(out):
        write_commands(root, hooks, header)


main()
