"""Reads a RenderDoc capture through RenderDoc's own Python module and writes what is in it as JSON.

    /usr/bin/python3 capture.py FRAME.rdc OUT.json

Replaying an OpenGL capture wants an X display; a virtual one will do (xvfb-run). Nothing is judged here: the
test beside this file does that.
"""

import json
import sys

import renderdoc as rd


def values_of(variable):
    """A uniform's numbers, row by row for matrices; those of an array's elements one after the other."""
    if variable.members:
        return [number for member in variable.members for number in values_of(member)]
    numbers = {rd.VarType.Float: variable.value.f32v, rd.VarType.SInt: variable.value.s32v}
    # Booleans and unsigned integers are stored alike.
    return list(numbers.get(variable.type, variable.value.u32v))[: variable.rows * variable.columns]


class Capture:
    def __init__(self, controller):
        self.controller = controller
        self.names = {resource.resourceId: resource.name for resource in controller.GetResources()}

    def draws(self, actions, groups=()):
        for action in actions:
            if action.flags & rd.ActionFlags.PushMarker:
                name = action.GetName(self.controller.GetStructuredFile())
                yield from self.draws(action.children, groups + (name,))
                continue
            if action.flags & rd.ActionFlags.Drawcall:
                yield self.draw(action, groups)
            yield from self.draws(action.children, groups)

    def draw(self, action, groups):
        self.controller.SetFrameEvent(action.eventId, True)
        pipeline = self.controller.GetPipelineState()
        state = self.controller.GetGLPipelineState()
        uniforms, samplers = {}, {}
        for stage in (rd.ShaderStage.Vertex, rd.ShaderStage.Pixel):
            shader = pipeline.GetShaderReflection(stage)
            for index, block in enumerate(shader.constantBlocks):
                buffer = pipeline.GetConstantBuffer(stage, index, 0)
                for variable in self.controller.GetCBufferVariableContents(
                    pipeline.GetGraphicsPipelineObject(),
                    shader.resourceId,
                    stage,
                    shader.entryPoint,
                    index,
                    buffer.resourceId,
                    buffer.byteOffset,
                    buffer.byteSize,
                ):
                    uniforms[variable.name] = values_of(variable)
            mapping = pipeline.GetBindpointMapping(stage)
            for sampler in shader.readOnlyResources:
                unit = mapping.readOnlyResources[sampler.bindPoint].bind
                texture = self.names.get(state.textures[unit].resourceId)
                samplers[sampler.name] = {"unit": unit, "texture": texture}
        framebuffer = state.framebuffer.drawFBO
        return {
            "groups": groups,
            "indices": action.numIndices,
            "program": self.names.get(state.fragmentShader.programResourceId),
            "vertex_array": self.names.get(state.vertexInput.vertexArrayObject),
            "target": self.names.get(framebuffer.colorAttachments[0].resourceId),
            "uniforms": uniforms,
            "samplers": samplers,
        }

    def everything(self):
        return {
            "draws": list(self.draws(self.controller.GetRootActions())),
            "textures": [
                {
                    "label": self.names.get(texture.resourceId),
                    "width": texture.width,
                    "height": texture.height,
                    "mips": texture.mips,
                    "samples": texture.msSamp,
                }
                for texture in self.controller.GetTextures()
            ],
            "buffers": [self.names.get(buffer.resourceId) for buffer in self.controller.GetBuffers()],
        }


def main(path, out):
    rd.InitialiseReplay(rd.GlobalEnvironment(), [])
    file = rd.OpenCaptureFile()
    result = file.OpenFile(path, "", None)
    if result != rd.ResultCode.Succeeded:
        sys.exit(f"{path} cannot be opened: {result}")
    result, controller = file.OpenCapture(rd.ReplayOptions(), None)
    if result != rd.ResultCode.Succeeded:
        sys.exit(f"{path} cannot be replayed: {result}")
    with open(out, "w", encoding="utf-8") as sink:
        json.dump({"driver": file.DriverName(), **Capture(controller).everything()}, sink)
    controller.Shutdown()
    file.Shutdown()
    rd.ShutdownReplay()


if __name__ == "__main__":
    main(*sys.argv[1:])
