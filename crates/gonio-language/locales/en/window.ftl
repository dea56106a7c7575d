# window

## app/actions

window-there-is-no-picture-yet-wait = there is no picture yet: wait until the scene is loaded
window-copied-the-link = copied the link
window-undone = Undone: { $step }
window-redone = Redone: { $step }
window-overlays-are-not-drawn-over-a = overlays are not drawn over a traced picture; press Shift + T for OpenGL's
window-the-frame-cannot-be-recorded = the frame cannot be recorded: { $error }
window-saved = saved { $place }
window-captured = The capture is saved: `qrenderdoc "{ $place }"` opens it in RenderDoc
window-copied-the-picture = copied the picture

## app/baking

window-nothing-is-baked-yet-press-bake = nothing is baked yet: press Bake first
window-baking-was-cancelled = baking was cancelled
window-baking-was-cancelled-because-another-scene = baking was cancelled, because another scene was opened
window-the-textures-are-baked = the textures are baked

## app/exercise

window-close-again-to-discard-your-changes = Close again to discard your changes: { $error }
window-close-again-to-keep-them-as = Close again to keep them as a draft, which is restored when you open these files again
window-your-changes-to-are-not-saved = Your changes to { $id } are not saved: Ctrl + S saves them. { $end }
window-your-changes-to-the-previous-files = Your changes to the previous files of { $id } are not saved: `Restore` brings them back. { $end }
window-your-changes-to-the-scene-are = Your changes to the scene { $title } are not saved: Ctrl + Shift + S saves them. { $end }
window-close-again-to-keep-the-scene = Close again to keep them as a draft, which is offered when you open this scene again
window-unsaved-changes-were-kept = Unsaved changes to { $title } from { $age } were kept
window-belongs-to-shaders-open-it-together = `{ $named }` belongs to shaders: open it together with them
window-opened = opened { $named }

## app/mod

window-opengl-rendering-is-not-available = OpenGL rendering is not available: { $error }
window-reading = reading { $inputs }
window-reloading = reloading { $changed }
window-reloaded = reloaded { $title }
window-reloaded-the-changed-files = reloaded the changed files
window-reading-the-scene-s-files = reading the scene's files

## app/unsaved

window-replaced-unsaved = Replaced { $title } (unsaved)
window-restored = restored { $title }

## document/changes

window-added-a-pane = added a pane
window-removed-a-pane = removed a pane
window-changed-the-arrangement-of-the-panes = changed the arrangement of the panes
window-changed-what-a-pane-shows = changed what a pane shows
window-changed-the-equation = changed the equation
window-changed-the-environment = changed the environment
window-changed-the-background = changed the background
window-changed-the-picture-s-settings = changed the picture's settings
window-moved-the-camera = moved the camera
window-switched-on = switched on { $name }
window-switched-off = switched off { $name }
window-light-number = light { $number }
window-object-number = object { $number }
window-added = added { $name }
window-removed = removed { $name }
window-moved = moved { $name }
window-turned = turned { $name }
window-scaled = scaled { $name }
window-renamed = renamed { $name }
window-changed = changed { $name }
window-changed-the-colour-of = changed the colour of { $name }
window-changed-the-intensity-of = changed the intensity of { $name }
window-changed-the-material-of = changed the material of { $name }

## document/pane

window-baked-picture = baked picture
window-no-specular-term = no specular term
window-spec-times-n-l = spec times <N.L>
window-spec-without-n-l = spec without <N.L>
window-of-light = { $quantity } of light { $light }
window-as-in-the-scene = as in the scene
window-traced-with-all-simplifications = traced with all simplifications
window-traced-up-to-step = traced up to step { $heading }
window-traced-simplified = traced, simplified: { $one }
window-traced-simplifications = traced, { $count } simplifications
window-per-face = per face
window-of-the-triangles = { $share } % of the triangles
window-triangles = { $triangles } triangles

## files/gathered

window-cannot-read-the-shader = cannot read the shader { $name }: { $error }
window-may-be-a-vertex-or-a = `{ $name }` may be a vertex or a fragment shader: name it .vert or .frag
window-and-are-both-shaders-open-one = `{ $other }` and `{ $name }` are both { $stage } shaders: open one of them
window-a-model-obj-gltf-glb-dae = a model (.obj .gltf .glb .dae .ply .stl .mesh .meshb), a scene (.toml), shaders (.vert .frag .glsl), a zip of these, or a picture as the environment
window-no-files-to-open = no files to open
window-belongs-to-a-model-open-it = `{ $one }` belongs to a model: open it together with the model
window-cannot-be-opened-expected = `{ $one }` cannot be opened: expected { $expected }
window-none-of-these-files-can-be = none of these { $count } files can be opened: expected { $expected }
window-the-six-faces-of-the-environment = the six faces of the environment were not found
window-these-pictures-are-not-one-environment = these { $count } pictures are not one environment: { $message }

## files/link

window-a-link-contains-the-scene-but = a link contains the scene but not its files such as `{ $file }`: save the scene and send both
window-the-scene-could-not-be-compressed = the scene could not be compressed: { $error }
window-the-scene-in-the-link-is = the scene in the link is damaged: copy the whole link

## files/memory

window-it-is-not-among-the-opened = it is not among the opened files; open it together with the others

## files/mod

window-cannot-read = cannot read { $path }: { $error }
window-and-more = { $first } and { $count } more

## files/zip

window-the-zip-file-is-truncated-or-2 = the zip file is truncated or damaged: its directory is missing
window-zip64-files-are-not-supported-unpack = Zip64 files are not supported: unpack the zip file and open its contents
window-the-zip-file-holds-files-more = the zip file holds { $count } files, more than { $most_files }: unpack it and open only those that you need
window-in-the-zip-file-is-encrypted = `{ $name }` in the zip file is encrypted: unpack it and open its contents
window-in-the-zip-file-is-larger = `{ $name }` in the zip file is larger than { $most } MiB, the limit for one file
window-the-zip-file-holds-more-than = the zip file holds more than { $bytes } MiB: unpack it and open its contents
window-in-the-zip-file-is-damaged-2 = `{ $name }` in the zip file is damaged: its size differs from the directory's entry
window-in-the-zip-file-is-damaged = `{ $name }` in the zip file is damaged: create the zip file again
window-in-the-zip-file-uses-an = `{ $name }` in the zip file uses an unsupported compression method: use Deflate or none
window-the-zip-file-is-truncated-or = the zip file is truncated or damaged: create it again

## missing_glyphs

window-more = { $count } more
window-and = { $names } and { $last }
window-no-font-has-the-character-displayed = No font has the character { $list }, displayed as a box: { $advice }
window-no-font-has-the-characters-displayed = No font has the characters { $list }, displayed as boxes: { $advice }

## panels/dialogs

window-keyboard-shortcuts = Keyboard shortcuts
window-path-of-a-file-folder-or = Path of a file, folder or zip file; you can also drop files on the window
window-path-of-a-binary-merl-brdf = Path of a .binary (MERL), .brdf, .glsl or .toml file; you can also drop files on the window
window-save-as = Save as
window-path-of-the-file = Path of the file
window-save = Save
window-path-of-a-model-scene-shader = Path of a model, scene, shader, zip file or picture; you can also drop files on the window
window-open = Open
window-cancel = Cancel

## panels/messages

window-messages-2 = { $file }: { $count } messages
window-messages = { $count } messages
window-dismiss-all = Dismiss all
window-show-fewer = Show fewer
window-show-all = Show all
window-times = { $text } ({ $times } times)
window-restore = Restore
window-discard = Discard
window-z-may-be-up = { $file } is an STL file: these usually have z up, not y as in this scene.
window-turn-z-up = Turn z up
window-dismiss = Dismiss
window-copy-the-message = Copy the message

## panels/status

window-x-ms = { $width } x { $height } { $draw_ms } ms
window-triangles-samples = { $triangles } triangles  { $samples } samples  { $time }
window-size-of-the-current-pane-and = Size of the current pane, and time of the last finished frame
window-files-and-megabytes = { NUMBER($count) ->
    [one] { $count } file, { $megabytes } MB
   *[other] { $count } files, { $megabytes } MB
}
window-pause-space = Pause (Space)
window-play-space = Play (Space)
window-back-to-time-0 = Back to time 0
window-time-within-the-longest-period-double = Time within the longest period. Double click: 0
window-of-s = { $within } of { $period } s

## panels/top_bar

window-brdf-bench-reflection-functions-plotted-compared = BRDF bench: reflection functions plotted, compared and checked
window-beyond = Beyond
window-beyond-the-rendering-equation-polarisation-interference = Beyond the rendering equation: polarisation, interference, fog and seven more
window-unwrap-the-model-and-bake-its = Unwrap the model, and bake its colours, normals or light into textures (Ctrl + B)
window-shader-exercises-edit-compare-with-the = Shader exercises: edit, compare with the correct answer, and check
window-files = Files
window-open-2 = Open...
window-open-a-model-or-a-scene = Open a model or a scene (Ctrl + O)
window-save-the-picture-or-the-scene = Save the picture or the scene, bake textures
window-samples = Samples
window-built-in-models-and-scenes = Built-in models and scenes
window-recent = Recent
window-recently-opened-files = Recently opened files
window-exercises = Exercises
window-brdf-bench = BRDF bench
window-undo-ctrl-z = Undo (Ctrl + Z)
window-redo-ctrl-y = Redo (Ctrl + Y)
window-frame-all-f = Frame all (F)
window-keyboard-shortcuts-2 = Keyboard shortcuts (?)
window-light-or-dark-theme-t = Light or dark theme (T)
window-bake-textures = Bake textures...
window-copy-the-picture = Copy the picture
window-a-link-to-this-page-with = A link to this page with the scene in it: sample models, lights, camera and all settings
window-copy-a-link-to-the-scene = Copy a link to the scene
window-six-faces-with-hard-edges-flat = Six faces with hard edges: flat and Phong shading look the same
window-a-rectangle-that-emits-the-light = A rectangle that emits the light of a picture
window-few-triangles-with-one-normal-per = Few triangles with one normal per face: the shadings differ most
window-few-triangles-with-averaged-normals-interpolation = Few triangles with averaged normals: interpolation hides the edges
window-many-triangles-all-shadings-look-the = Many triangles: all shadings look the same
window-several-materials-and-textures-on-one = Several materials and textures on one table
window-blender-s-monkey-head = Blender's monkey head
window-each-simplification-of-the-rendering-equation-2 = Each simplification of the rendering equation costs little here
window-objects-that-reflect-and-refract-their = Objects that reflect and refract their surroundings
window-each-simplification-of-the-rendering-equation = Each simplification of the rendering equation costs much here
window-the-scene-of-exercise-07 = The scene of exercise 07
window-a-directional-a-point-and-a = A directional, a point and a spot light side by side
window-flat-gouraud-and-phong-shading-side = Flat, Gouraud and Phong shading side by side
window-three-spheres-under-three-lights = Three spheres under three lights

## platform/desktop/bake

window-the-textures-could-not-be-baked = the textures could not be baked: the work ended unexpectedly

## platform/desktop/check

window-the-check-could-not-be-started = the check could not be started: { $error }
window-the-check-ended-without-an-answer = the check ended without an answer: try again

## platform/desktop/drafts

window-a-folder-in-could-not-be = a folder in `{ $root }` could not be created: { $error }

## platform/desktop/fonts

window-install-a-font-of-this-script-2 = install a font of this script and restart gonio
window-install-a-font-of-this-script = install a font of this script, on Debian and Ubuntu by `apt-get install { $packages }`, and restart gonio

## platform/desktop/mod

window-the-gonio-program-was-not-found-2 = the gonio program was not found: run `gonio lab check` in a terminal
window-the-gonio-program-was-not-found = the gonio program was not found
window-there-is-no-home-folder-home = there is no home folder (HOME is not set)
window-gonio-render-draws-without-a-window = `gonio render` draws without a window
window-there-is-no-display-neither-wayland = there is no display: neither WAYLAND_DISPLAY nor DISPLAY is set; { $instead }
window-the-window-needs-which-is-not = the window needs { $library }, which is not installed: on Debian and Ubuntu, run `apt-get install { $package }`
window-on-debian-and-ubuntu-apt-get = on Debian and Ubuntu: apt-get install libgl1-mesa-dri libegl1 libxcursor1 libxi6 libxkbcommon-x11-0
window-the-window-could-not-be-opened = the window could not be opened: { $words }
window-the-window-has-no-opengl = the window has no OpenGL ({ $words }); { $packages }; { $instead }
window-the-display-cannot-be-reached-check = the display cannot be reached ({ $words }); check DISPLAY or WAYLAND_DISPLAY, { $packages }; { $instead }

## platform/desktop/open

window-there-are-no-files-in = there are no files in { $places }
window-there-are-more-than-files-in = there are more than { $count } files in { $places }: open only those of the exercise
window-is-too-large-for-an-exercise = `{ $path }` is too large for an exercise: { $megabytes } MB
window-cannot-be-read = `{ $folder }` cannot be read: { $error }

## platform/desktop/stations

window-the-station-cannot-be-computed-the = the station cannot be computed: the work ended unexpectedly

## platform/desktop/storage

window-could-not-be-written = `{ $place }` could not be written: { $error }
window-no-such-folder-create-it-or = no such folder: create it, or choose another
window-permission-denied-choose-another-folder = permission denied: choose another folder
window-this-is-a-folder-add-a = this is a folder: add a file name
window-the-file-name-is-missing = the file name is missing
window-the-disk-is-full = the disk is full
window-choose-another-place = { $error }: choose another place

## platform/desktop/trace

window-the-scene-could-not-be-traced = the scene could not be traced: the path tracer ended unexpectedly

## platform/desktop/trial

window-the-shader-test-could-not-be-2 = the shader test could not be started: { $why }
window-the-test-of-these-shaders-ended = the test of these shaders ended without an answer
window-the-test-of-this-shader-ended = the test of this shader ended without an answer
window-the-shader-test-could-not-be = the shader test could not be monitored: { $why }
window-the-shader-could-not-be-tested = the shader could not be tested outside of the window
window-this-shader-crashed-the-process-that = This shader crashed the process that tests it, so the window does not draw it: look for very large arrays, very long expressions or deep nesting
window-this-shader-needs-about-seconds-for = This shader needs about { $seconds } seconds for a single picture, so the window does not draw it: look for a loop with too many iterations
window-this-shader-failed-in-a-test = This shader failed in a test, so the window does not draw it: { $why }
window-the-process-that-tests-shaders-gave = the process that tests shaders gave no answer
window-this-shader-did-not-finish-within = This shader did not finish within { $seconds } seconds in a test, so the window does not draw it: look for a loop that never ends
window-this-shader-took-more-than-1 = This shader took more than 1 GB of memory in a test, so the window does not draw it: look for very large arrays, or macros that multiply each other
window-the-test-of-this-shader-was = the test of this shader was stopped

## platform/desktop/worker

window-the-process-has-no-input-or = the process has no input or no output
window-the-check-could-not-be-monitored = the check could not be monitored: { $error }
window-the-check-was-stopped = the check was stopped
window-the-answer-of-the-check-could = the answer of the check could not be understood: { $error }

## platform/mod

window-install-a-font-of-this-script-3 = install a font of this script and load the page again
window-checks-are-not-available-here-run = checks are not available here: run `gonio lab check` on the command line
window-renderdoc-is-not-loaded-preload = RenderDoc must be loaded when the window starts: run `LD_PRELOAD=librenderdoc.so gonio view` to capture frames
window-renderdoc-is-not-loaded-launch = RenderDoc must be loaded when the window starts: run `gonio view` from RenderDoc (Launch Application) to capture frames
window-renderdoc-does-not-run-here = RenderDoc does not run here, only on Linux and Windows
window-there-are-no-processes-here = there are no processes here
window-this-shader-is-not-drawn-because = This shader is not drawn because it may never finish: { $reason }

## platform/web/bake

window-the-textures-could-not-be-baked-3 = the textures could not be baked: { $error }
window-the-textures-could-not-be-baked-2 = the textures could not be baked: the worker's answer is damaged

## platform/web/document

window-the-page-has-no-window = the page has no window
window-the-browser-does-not-allow-choosing = the browser does not allow choosing files: drop them on the page
window-could-not-be-downloaded = `{ $name }` could not be downloaded: { $error }
window-this-browser-has-no-storage-for = this browser has no storage for this page
window-the-browser-s-storage-for-this = the browser's storage for this page is full

## platform/web/mod

window-only-built-in-files-can-be = only built-in files can be read here
window-a-web-page-cannot-open-by = a web page cannot open { $names } by its path: drop the file on the page
window-the-verdict-could-not-be-understood = the verdict could not be understood: { $error }

## platform/web/stations

window-the-worker-s-answer-is-damaged = the worker's answer is damaged
window-the-station-cannot-be-computed = the station cannot be computed: { $reason }

## platform/web/trace

window-the-scene-could-not-be-traced-2 = the scene could not be traced: { $error }

## saving

window-picture-as-displayed-png = Picture as displayed (PNG)
window-picture-at-the-scene-s-resolution = Picture at the scene's resolution (PNG)
window-linear-light-exr = Linear light (EXR)
window-scene-toml = Scene (TOML)
window-renderdoc-capture-rdc = RenderDoc capture (RDC)
window-plot-svg = Plot (SVG)
window-plot-png = Plot (PNG)
window-obj-and-png = OBJ and PNG

## session/equation

window-a-ambient-light-the-same-from = A, ambient light: the same from every direction, never attenuated
window-e-the-light-that-the-surface = E, the light that the surface emits
window-light-from-the-environment-diffuse-and = Light from the environment: diffuse and glossy reflection
window-diff-k-d-the-diffuse-term = diff k_d, the diffuse term: the same in every viewing direction
window-k-s-spec-i-the-specular = k_s spec_i, the specular term: the highlight
window-l-i-the-colour-of-light = L_i, the colour of light i times its intensity
window-att-i-attenuation-the-decrease-of = att_i, attenuation: the decrease of light with distance
window-spot-i-the-soft-edge-of = spot_i, the soft edge of a spot light's cone
window-n-l-i-the-cosine-of = <N.L_i>, the cosine of the angle between normal and light direction, at least 0

## session/hints

window-tip-click-the-picture-to-see = Tip: click the picture to see every number of the equation at that pixel.
window-tip-drag-a-lamp-in-the = Tip: drag a lamp in the picture.
window-tip-click-a-term-of-the = Tip: click a term of the equation to switch it off.

## session/mod

window-lights = Lights
window-objects = Objects
window-camera = Camera
window-picture = Picture
window-probe = Probe
window-compare = Compare
window-frame = Frame
window-shaders = Shaders
window-bake = Bake
window-lights-each-adds-one-summand-to = Lights: each adds one summand to the equation
window-models-their-transformations-and-materials = Models, their transformations and materials
window-camera-parameters-and-matrices = Camera parameters and matrices
window-environment-background-exposure-and-tone-mapping = Environment, background, exposure and tone mapping
window-the-light-equation-at-one-pixel = The light equation at one pixel, in numbers
window-the-scene-with-up-to-four = The scene with up to four settings side by side
window-the-opengl-calls-that-drew-this = The OpenGL calls that drew this picture
window-your-own-shaders-and-the-values = Your own shaders and the values of their uniforms
window-textures-for-new-texture-coordinates-baked = Textures for new texture coordinates, baked from the scene

## session/own_shaders

window-the-graphics-were-reset-while-your = the graphics were reset while your shaders were drawn: they may have a loop that never ends; open them again after a change
window-cannot-read-the-texture = cannot read the texture { $path }: { $error }

## session/probing

window-light = light { $index }
window-light-of-this-source-that-only = Light of this source that only the visible surface scattered
window-light-that-no-surface-scattered-of = Light that no surface scattered: of what shines itself, or the background
window-object = object { $object }
window-k-a-times-the-ambient-light = k_a times the ambient light
window-first-bounce = first bounce
window-light-that-two-surfaces-scattered = Light that two surfaces scattered
window-the-rest = the rest
window-light-that-more-than-two-surfaces = Light that more than two surfaces scattered
window-the-sum-which-is-the-traced = The sum, which is the traced picture's pixel
window-standard-error = standard error
window-of-the-total-how-far-it = Of the total: how far it may be from its true value

## shortcuts

window-in-the-picture = In the picture
window-the-window = The window
window-in-an-exercise-or-with-your = In an exercise, or with your own shaders
window-drag = Drag
window-orbit-around-the-target = orbit around the target
window-shift-drag = Shift + drag
window-right-button-drag = Right button + drag
window-look-around = look around
window-wheel = Wheel
window-w-a-s-d-z-q = w a s d, z q s d, arrows
window-fly-e-and-c-move-up = fly; e and c move up and down; Shift is faster
window-frame-all = frame all
window-space = Space
window-play-or-pause-the-animation = play or pause the animation
window-probe-the-pixel-under-the-pointer = probe the pixel under the pointer; a click pins it, Esc unpins it
window-show-the-camera-and-its-frustum = show the camera and its frustum from outside
window-bounding-boxes = bounding boxes
window-ground-with-a-contact-shadow = ground with a contact shadow
window-checkerboard-of-the-texture-coordinates = checkerboard of the texture coordinates
window-overdraw-fragments-per-pixel = overdraw: fragments per pixel
window-the-traced-picture-the-rendering-equation = the traced picture: the rendering equation in place of the light equation
window-double-click-on-a-value = Double click on a value
window-reset-it-to-its-default = reset it to its default
window-ctrl-plus-ctrl-minus = Ctrl + plus, Ctrl + minus
window-enlarge-or-shrink-the-interface-ctrl = enlarge or shrink the interface; Ctrl + 0 resets it
window-switch-between-light-and-dark-theme = switch between light and dark theme
window-show-this-list = show this list
window-close-the-open-dialog = close the open dialog
window-open-files-or-drop-them-on = open files (or drop them on the window)
window-save-the-scene = save the scene
window-bake-textures-2 = bake textures
window-save-the-picture = save the picture
window-check-the-shaders-of-an-exercise = check the shaders of an exercise
window-find-in-the-text-go-to = find in the text, go to the next or the previous match
window-indent-the-selected-lines-in-the = indent the selected lines in the editor, or go back a step
window-make-the-selected-lines-comments-or = make the selected lines comments, or code again
window-leave-the-editor-then-tab-goes = leave the editor; then Tab goes to the next control
window-click-on-the-picture-f9 = Click on the picture, F9
window-show-each-line-s-values-at = show each line's values at that pixel, or at the picture's middle
window-next-or-previous-step-over-calls = next or previous step, over calls; also Alt + Down, Alt + Up
window-next-or-previous-step-into-calls = next or previous step, into calls; also Alt + Right, Alt + Left
window-shift-alt-arrows = Shift + Alt + arrows
window-move-the-pinned-pixel = move the pinned pixel
window-value-and-picture-of-the-expression = value and picture of the expression at the cursor; the pointer shows them too
window-the-picture = the picture
window-views-in-place-of-the-picture = Views in place of the picture

## truth

window-not-possible-here = not possible here
window-the-first-paths-are-on-their = the first paths are on their way
window-1-path-per-pixels = 1 path per { $paths } pixels
window-1-path-per-pixel = 1 path per pixel
window-paths-per-pixel = { $paths } paths per pixel
window-paths-and-error = { $paths }, error { $percent } %

## widgets/color

window-linear = linear { $r }, { $g }, { $b }
window-double-click = Double click: { $default }
window-color-text = color text
window-rrggbb-srgb-or-r-g-b = #rrggbb (sRGB), or r,g,b or one number (linear, may exceed 1)

## widgets/number

window-from-to = From { $low }{ $unit } to { $high }{ $unit }
window-at-least = At least { $low }{ $unit }
window-double-click-2 = Double click: { $default }{ $unit }

## widgets/parameters

window-largest-channel = { $name }, largest channel

## short words

window-copied = copied
window-pan = pan
window-zoom = zoom
window-redo = redo
window-undo = undo
window-language = Language
window-the-model-is-not-converted-yet = the model is not converted yet: wait until it is read
window-file = File
window-what-the-model-s-file-holds = What the model's file holds, and the files that it names
window-gallery = Gallery...
window-every-technique-on-several-models = Every technique on several models, as scenes to open
window-convert-the-environment = Convert the environment...
window-the-environment-as-six-faces = The environment as six faces, a cross, a panorama or KTX2; the check of its orientation
window-environment = Environment
window-faces-of-the-environment = The environment as six faces and as a panorama, checked and converted
