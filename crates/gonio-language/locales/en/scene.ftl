# scene

## panels/camera

scene-place = Place
scene-camera-position-in-world-space = Camera position in world space
scene-position = Position
scene-the-point-that-the-camera-looks = The point that the camera looks at, in world space
scene-target = Target
scene-yaw = Yaw
scene-yaw-of-the-viewing-direction-90 = Yaw of the viewing direction; -90° looks along -Z
scene-pitch = Pitch
scene-pitch-positive-looks-up = Pitch; positive looks up
scene-worldup-the-up-direction-made-perpendicular = WorldUp: the up direction, made perpendicular to the viewing direction
scene-up = Up
scene-lens = Lens
scene-field-of-view-2 = Field of view
scene-full-vertical-angle = Full vertical angle
scene-full-vertical-field-of-view-the = Full vertical field of view; the lab's 45 rad are 58.3°
scene-field-of-view = field of view
scene-near = Near
scene-distance-of-the-near-plane-in = Distance of the near plane, in world units
scene-far = Far
scene-distance-of-the-far-plane-in = Distance of the far plane, in world units
scene-1-for-points = 1, for points
scene-1-w-becomes-the-depth-by = −1: w becomes the depth, by which x, y and z are divided
scene-view-matrix-v = View matrix V
scene-from-world-to-eye-space-the = From world to eye space: the camera axes as rows, and in the last column minus the position in those axes
scene-projection-matrix-p = Projection matrix P
scene-from-eye-to-opengl-s-clip = From eye to OpenGL's clip space: z from -1 (near) to 1 (far)

## panels/compare/measured

scene-nothing-has-been-drawn-yet = Nothing has been drawn yet
scene-vertex-shader-runs-where-gouraud-shading = Vertex shader runs, where Gouraud shading evaluates the equation; fragment shader runs (including helper fragments in blocks of 2 x 2), where the other shadings do; and the time of the last finished frame
scene-the-panes-have-not-been-compared = The panes have not been compared yet
scene-pixels = { $count } pixels, { $percent } %
scene-differing = Differing
scene-by-more-than-1-255-in = By more than 1/255 in some channel
scene-largest = Largest
scene-8-bit-steps = 8-bit steps
scene-mean = Mean
scene-of-the-absolute-differences-8-bit = Of the absolute differences, 8-bit steps
scene-root-of-the-mean-square = Root of the mean square, 8-bit steps
scene-db = { $db } dB
scene-20-log10-255-rms = 20 log10(255 / RMS)
scene-maximum-at = Maximum at
scene-column-and-row-of-the-pixel = Column and row of the pixel, circled in the map
scene-a-part-of-it-is-noise = A part of it is noise, which fades ({ $traced })
scene-stop = Stop
scene-draw-the-curve = Draw the curve
scene-draw-it-again = Draw it again
scene-draws-the-scene-with-more-and = Draws the scene with more and more triangles in flat, Gouraud and Phong shading, and compares each picture with the finest one
scene-of = { $done } of { $all }
scene-rms-difference-0-to-255 = RMS difference (0 to 255)
scene-error-curve = error curve
scene-against = against { $against }
scene-per-face = per face

## panels/compare/mod

scene-pane = Pane { $current }
scene-measured = Measured
scene-one-sample-per-pixel-while-something = One sample per pixel while something moves, if frames are slow
scene-one-sample-while-moving = One sample while moving
scene-error-against-the-finest-mesh = Error against the finest mesh
scene-panes = Panes
scene-remove-pane = Remove pane { $index }
scene-add-a-copy-of-this-pane = Add a copy of this pane
scene-apply-to-all-panes = Apply to all panes
scene-copies-the-settings-of-the-current = Copies the settings of the current pane to the others
scene-arrangement = Arrangement
scene-side-by-side = Side by side
scene-all-panes-next-to-each-other = All panes next to each other
scene-wipe = Wipe
scene-two-panes-on-top-of-each = Two panes on top of each other, with a divider to drag
scene-difference = Difference
scene-colour-map-of-the-difference-between = Colour map of the difference between two panes
scene-the-difference-in-8-bit-steps = The difference, in 8-bit steps, that gets the brightest colour
scene-full-scale = Full scale
scene-signed-second-minus-first = Signed: second minus first
scene-signed = Signed

## panels/compare/plot

scene-triangles-of-255 = { $name }: { $triangles } triangles, { $difference } of 255

## panels/compare/settings

scene-as-in-the-scene = as in the scene
scene-shading = Shading
scene-specular-term = Specular term
scene-convention = Convention
scene-spec-times-n-l = spec times <N.L>
scene-view = View
scene-reset-to-the-scene = Reset to the scene
scene-triangles = Triangles
scene-double-click-as-in-the-scene = Double click: as in the scene
scene-triangles-of-each-sphere-8-f = Triangles of each sphere: 8 f², from an octahedron's faces
scene-triangles-of-the-sphere = Triangles of the sphere
scene-share-of-each-model-s-triangles = Share of each model's triangles that is kept
scene-share-of-the-triangles = Share of the triangles
scene-one = One
scene-one-pane-with-the-scene-s = One pane with the scene's settings
scene-flat-gouraud-phong = Flat | Gouraud | Phong
scene-where-the-equation-is-evaluated = Where the equation is evaluated
scene-r-v-or-n-h-to = ⟨R·V⟩ or ⟨N·H⟩ to the power of g, the shininess
scene-lab-physical = Lab | physical
scene-without-and-with-1-and-the = Without and with 1/π and the cosine of the specular term
scene-traced-opengl = Traced | OpenGL
scene-the-rendering-equation-by-following-paths = The rendering equation by following paths of light, and the light equation that simplifies it
scene-coarse-smooth = Coarse | smooth
scene-few-and-many-triangles = Few and many triangles

## panels/compare/truth

scene-traced-the-rendering-equation = Traced: the rendering equation
scene-traced = Traced
scene-error-the-noise-of-a-pixel = Error: the noise of a pixel, relative to the picture's mean. Four times the paths halve it.
scene-points-per-lamp-2 = points per lamp
scene-point-lights-that-replace-each-lamp = Point lights that replace each lamp; 1: at its centre
scene-points-per-lamp = Points per lamp
scene-simplified-step-by-step-to-the = Simplified, step by step, to the light equation
scene-makes-all-simplifications-up-to-this = Makes all simplifications up to this step of the lecture
scene-step-2 = Step
scene-the-truth = the truth
scene-step = step { $heading }

## panels/equation/mod

scene-term = { $term } term
scene-a-brdf-has-no-ambient-term = a BRDF has no ambient term
scene-alone-or-all-terms-again = { $term } alone, or all terms again
scene-is-on = { $term } is on
scene-is-off = { $term } is off
scene-alone-2 = { $term } alone
scene-show-all-terms-again = Show all terms again
scene-show-this-term-alone-or-double = Show this term alone (or double-click it)
scene-alone = Alone
scene-all-terms-on = All terms on
scene-all-terms-are-on = all terms are on
scene-hide-the-definitions = Hide the definitions
scene-show-the-definitions = Show the definitions
scene-definition-of = definition of { $term }
scene-click-show-the-lights = Click: show the lights
scene-click-switch-off-double-click-show = Click: switch off. Double click: show it alone
scene-click-switch-on-double-click-show = Click: switch on. Double click: show it alone
scene-click-switch-off-counts-as-1 = Click: switch off (counts as 1)
scene-click-switch-on = Click: switch on
scene-the-scene-s-ambient-light-is = The scene's ambient light is { $r }, { $g }, { $b }
scene-no-material-of-this-scene-emits = No material of this scene emits light
scene-one-material-of-this-scene-emits = One material of this scene emits light
scene-materials-of-this-scene-emit-light = { $n } materials of this scene emit light
scene-environment-intensity = Environment { $image }, intensity { $intensity }
scene-the-diffuse-part-of-the-brdf = The diffuse part of the BRDF { $brdf }
scene-by-the-convention = By the { $convention } convention
scene-the-lobe-of-the-brdf = The lobe of the BRDF { $brdf }
scene-none-a-click-selects-blinn-phong = None; a click selects Blinn-Phong
scene-0-where-the-light-is-behind-2 = , 0 where the light is behind the surface
scene-of-lights-are-on = { $on } of { $count } lights are on
scene-this-scene-has-only-directional-lights = This scene has only directional lights: att is 1
scene-applies-to-one-light-directional-lights = Applies to one light; directional lights have att = 1
scene-applies-to-lights-directional-lights-have = Applies to { $n } lights; directional lights have att = 1
scene-this-scene-has-no-spot-light = This scene has no spot light: spot is 1
scene-applies-to-one-spot-light-other = Applies to one spot light; other lights have spot = 1
scene-applies-to-spot-lights-other-lights = Applies to { $n } spot lights; other lights have spot = 1
scene-0-where-the-light-is-behind = 0 where the light is behind the surface

## panels/equation/parameters

scene-intensity-of-the-environment = intensity of the environment
scene-this-scene-has-no-environment-select = This scene has no environment; select one in the Picture tab
scene-the-sum-of-the-ambient-lights = the sum of the ambient lights, never attenuated
scene-each-light-adds-one-summand = each light adds one summand
scene-set-per-light-1-for-directional = set per light; 1 for directional lights
scene-0-at-the-edge-of-the = 0 at the edge of the cone, 1 inside; 1 for other lights
scene-objects-cast-shadows-the-light-of = Objects cast shadows: the light of directional, point and spot lights reaches only what it sees
scene-set-per-material = set per material
scene-flip-the-normal-of-back-faces = Flip the normal of back faces towards the viewer
scene-specular-model = specular model
scene-no-specular-light-where-n-l = No specular light where N⋅L ≤ 0
scene-multiply-the-specular-term-by-n = Multiply the specular term by <N.L>, which the lab's equation omits
scene-times-n-l = times <N.L>
scene-the-lab-s-diffuse-and-specular = The lab's diffuse and specular terms
scene-a-brdf-1-sr-in-place = A BRDF (1/sr) in place of the diffuse and specular terms; it has no ambient term
scene-with-the-factor-that-conserves-energy = With the factor that conserves energy
scene-diagonal-of-a = diagonal of A
scene-diagonal-of-a-along-tangent-bitangent = Diagonal of A along tangent, bitangent and normal; 1, 1, -1 is Phong's lobe

## panels/frame/draw

scene-samplers-units-textures = Samplers, units, textures ({ $count })
scene-this-draw-samples-no-texture = This draw samples no texture.
scene-uniforms = Uniforms ({ $count })
scene-attributes = Attributes ({ $count })
scene-not-counted-by-this-driver = not counted by this driver
scene-not-tested = not tested
scene-written = { $test }, written
scene-not-written = { $test }, not written
scene-front-is = { $cull }, front is { $front_face }
scene-and = { $first } and { $second }
scene-vertex-shader-runs = vertex shader runs
scene-fragment-shader-runs = fragment shader runs
scene-x-from = { $width } x { $height } from { $x }, { $y }
scene-texture = texture { $id },{" "}
scene-reads-unit = reads unit { $unit }: { $id }{ $name }
scene-the-sampler-holds-the-texture-unit = The sampler `{ $name }` holds { $unit }, the texture unit that the texture is bound to
scene-no-texture-is-bound-to-this = no texture is bound to this unit
scene-1-level = 1 level
scene-levels = { $count } levels
scene-samples = { $samples } samples
scene-never-set = never set
scene-and-more = and { $rest } more
scene-none-the-vertex-shader-computes-the = None: the vertex shader computes the vertices from gl_VertexID.
scene-for-all-vertices = { $x }, { $y }, { $z }, { $w } for all vertices
scene-program = Program
scene-vertex-shader = Vertex shader
scene-fragment-shader = Fragment shader

## panels/frame/mod

scene-there-is-no-picture-yet = There is no picture yet.
scene-samples-2 = , { $samples } samples
scene-into-x = into `{ $name }`: { $width } x { $height }{ $samples } { $format }
scene-vertices = { $other }, { $count } vertices
scene-capture-with-renderdoc = Capture with RenderDoc
scene-every-draw-texture-and-uniform = Every draw, texture and uniform of the current pane's picture, as a file for RenderDoc
scene-no-problems-found-in-this-frame = No problems found in this frame
scene-every-sampler-reads-a-bound-texture = Every sampler reads a bound texture, every uniform is set, and every attribute has data.
scene-and-more-2 = {" "}and { $count } more
scene-draw = draw { $draw }{ $more }

## panels/lights/details

scene-name = Name
scene-used-in-reports-and-lists = Used in reports and lists
scene-kind = Kind
scene-kind-of-light = kind of light
scene-position-in-world-space-at-time = Position in world space, at time 0 if the light moves
scene-direction-of-the-light-s-travel = Direction of the light's travel, of any length
scene-direction = Direction
scene-colour-of-l-i-linear-rgb = Colour of L_i, linear RGB
scene-colour = Colour
scene-relative-power-by-wavelength-the-scene = Relative power by wavelength; the scene file has it. The colour is derived from it, and another colour replaces it
scene-spectrum = Spectrum
scene-radius-of-the-lamp-in-world = Radius of the lamp, in world units; the light equation uses its centre
scene-radius = Radius
scene-width-and-height-of-the-lamp = Width and height of the lamp, in world units; the light equation uses its centre
scene-size = Size
scene-k-c-the-constant-coefficient = k_c, the constant coefficient
scene-k-l-the-linear-coefficient = k_l, the linear coefficient
scene-k-q-the-quadratic-coefficient-k = k_q, the quadratic coefficient; k_c = k_l = 0, k_q = 1 is the inverse square law
scene-inner-angle = Inner angle
scene-half-angle-of-the-cone-with = Half angle of the cone with full intensity
scene-outer-angle = Outer angle
scene-half-angle-of-the-cone-outside = Half angle of the cone outside of which there is no light
scene-duplicate-this-light = Duplicate this light
scene-move-up = Move up
scene-move-down = Move down
scene-remove-this-light = Remove this light
scene-att-at-d = att = { $attenuation } at d = { $distance }
scene-att-as-a-function-of-the = att as a function of the distance d; the dot marks the centre of the scene
scene-the-light-does-not-move = The light does not move
scene-motion = Motion
scene-motion-over-time = Motion over time
scene-period = Period
scene-duration-of-one-cycle-in-seconds = Duration of one cycle, in seconds
scene-amplitude = Amplitude
scene-largest-displacement-in-world-units = Largest displacement, in world units
scene-centre = Centre
scene-centre-of-the-circle-in-world = Centre of the circle, in world space
scene-axis = Axis
scene-axis-of-rotation = Axis of rotation
scene-point = Point { $number }
scene-in-world-space-the-path-is = In world space; the path is closed
scene-remove-this-point = Remove this point
scene-add-a-point = Add a point

## panels/lights/edits

scene-copy = { $copy } copy
scene-a-light-was-added = a { $kind } light was added

## panels/lights/mod

scene-no-lights-only-a-e-and = No lights: only A, E and the environment remain
scene-on-click-to-switch-it-off = on; click to switch it off
scene-off-click-to-switch-it-on = off; click to switch it on
scene-show-all-lights-again = show all lights again
scene-show-this-light-alone = show this light alone
scene-parameters-of = Parameters of { $name }
scene-intensity-l-i-is-the-colour = Intensity: L_i is the colour times the intensity
scene-colour-of-the-light = colour of the light
scene-colour-of-l-i = Colour of L_i
scene-add = Add
scene-add-light = Add: { $kind } light

## panels/objects/material

scene-in-the-file = { $one } in the file
scene-and-more-in-the-file-changes = { $one } and { $count } more in the file; changes apply to all of them
scene-ambient-colour-k-a-linear-rgb = Ambient colour k_a, linear RGB
scene-diffuse-colour-k-d-linear-rgb = Diffuse colour k_d, linear RGB
scene-reflectance-by-wavelength-0-to-1 = Reflectance by wavelength, 0 to 1; the scene file has it. k_d is derived from it, and another k_d replaces it
scene-specular-colour-k-s-linear-rgb = Specular colour k_s, linear RGB
scene-emitted-light-linear-rgb = Emitted light, linear RGB
scene-shininess-g-the-exponent-of-the = Shininess g: the exponent of the highlight
scene-opacity = Opacity
scene-1-is-opaque-0-invisible = 1 is opaque, 0 invisible
scene-textures = Textures
scene-whether-the-model-s-textures-are = Whether the model's textures are used
scene-as-in-the-file-2 = as in the file
scene-ignore-the-textures = Ignore the textures
scene-an-opaque-surface = An opaque surface
scene-medium = Medium
scene-a-transparent-body-of-this-medium = A transparent body of this medium
scene-index = Index η
scene-index-of-refraction-air-1 = Index of refraction (air: 1)
scene-reflectivity = Reflectivity
scene-0-is-the-lit-surface-1 = 0 is the lit surface, 1 a mirror
scene-transmission = Transmission
scene-0-is-opaque-1-transparent = 0 is opaque, 1 transparent
scene-default-exact = default (exact)
scene-default-none = default (none)
scene-default-schlick = default (Schlick)
scene-exact-for-a-medium-none-for = Exact for a medium, none for a surface
scene-fresnel = Fresnel
scene-dependence-of-the-reflection-on-the = Dependence of the reflection on the angle
scene-tint = Tint
scene-colour-of-the-transmitted-light-0 = Colour of the transmitted light, 0 to 1
scene-absorption = Absorption
scene-per-world-unit-and-channel-between = Per world unit and channel, between two surfaces
scene-dispersion = Dispersion
scene-index-of-refraction-for-blue-light = Index of refraction for blue light minus that for red
scene-default-one = default (one)
scene-default-two = default (two)
scene-as-in-the-lab = As in the lab
scene-surfaces = Surfaces
scene-number-of-surfaces-at-which-light = Number of surfaces at which light is refracted
scene-reset-to-the-value-in-the = Reset to the value in the file
scene-as-in-the-file = As in the file

## panels/objects/parts

scene-parts = Parts ({ $count })
scene-all-parts = All parts
scene-material-of-part = Material of { $name }

## panels/objects/mod

scene-bake-textures = Bake textures...
scene-unwrap-the-objects-and-bake-their = Unwrap the objects, and bake their colours, normals or light into textures (Ctrl + B)
scene-triangles-2 = { $count } triangles
scene-properties-of = Properties of { $name }
scene-material = Material
scene-there-is-no-environment-so-this = There is no environment, so this material shows only the background in its reflections and refractions.
scene-add-a-sky = Add a sky
scene-used-in-reports-and-opengl-debug = Used in reports and OpenGL debug groups
scene-applied-last-in-world-units = Applied last, in world units
scene-translation = Translation
scene-about-the-world-s-x-then = About the world's x, then y, then z axis
scene-rotation = Rotation
scene-applied-first-per-axis-hold-shift = Applied first, per axis; hold Shift to drag finely
scene-scale = Scale
scene-motion-over-time-as-in-the = Motion over time, as in the scene file
scene-normals = Normals
scene-source-of-the-mesh-s-normals = Source of the mesh's normals
scene-edges-with-a-larger-angle-stay = Edges with a larger angle stay sharp; 180° averages all normals
scene-crease-angle-2 = Crease angle
scene-crease-angle = crease angle
scene-triangles-vertices = { $triangles } triangles, { $vertices } vertices
scene-mesh = Mesh
scene-as-it-is-drawn = As it is drawn
scene-frame-this-object = Frame this object
scene-duplicate-this-object = Duplicate this object
scene-remove-this-object = Remove this object
scene-a-scene-needs-at-least-one = A scene needs at least one object
scene-add-a-sample-model = Add a sample model
scene-was-added = { $name } was added

## panels/picture

scene-view-of-this-pane = View of this pane
scene-environment = Environment
scene-display = Display
scene-vectors = Vectors
scene-terms = Terms
scene-factors = Factors
scene-places = Places
scene-the-picture = the picture
scene-l-o-with-exposure-tone-mapping = L_o with exposure, tone mapping and colour encoding
scene-a-vector-term-or-factor-of = A vector, term or factor of the equation as a colour (number keys)
scene-what-is-shown = what is shown
scene-sum-of-all = sum of all
scene-sum-over-all-lights = Sum over all lights
scene-the-first = the first
scene-the-first-light-that-is-not = The first light that is not ambient
scene-of-light = Of light
scene-light-whose-contribution-is-shown = Light whose contribution is shown
scene-of-which-light = of which light
scene-six-labelled-colours-one-per-face = Six labelled colours, one per face
scene-a-sky-with-a-sun = A sky with a sun
scene-a-room-with-windows = A room with windows
scene-only-the-background-colours = Only the background colours
scene-from-the-scene = From the scene
scene-image = Image
scene-surroundings-of-the-scene-drop-a = Surroundings of the scene; drop a panorama or six cube faces to use your own
scene-light = Light
scene-whether-the-environment-lights-the-objects = Whether the environment lights the objects
scene-diffuse-light-and-glossy-reflection = Diffuse light and glossy reflection
scene-lights-the-objects = lights the objects
scene-background = Background
scene-whether-the-environment-is-visible-behind = Whether the environment is visible behind the objects
scene-is-visible = is visible
scene-behind-the-objects = Behind the objects
scene-intensity = Intensity
scene-factor-on-the-light-of-the = Factor on the light of the environment
scene-yaw-pitch-and-roll-about-y = Yaw, pitch and roll: about y, then x, then z
scene-yaw-to-the-left = Yaw: to the left
scene-pitch-upwards = Pitch: upwards
scene-roll = Roll
scene-blur = Blur
scene-blur-of-the-visible-environment = Blur of the visible environment
scene-top = Top
scene-colour-at-the-upper-edge-linear = Colour at the upper edge, linear RGB
scene-background-at-the-top = background at the top
scene-bottom = Bottom
scene-colour-at-the-lower-edge-linear = Colour at the lower edge, linear RGB
scene-background-at-the-bottom = background at the bottom
scene-saved-pictures-get-an-alpha-channel = Saved pictures get an alpha channel
scene-exposure = Exposure
scene-stops-each-doubles-the-light = Stops: each doubles the light
scene-tone-map-2 = Tone map
scene-maps-light-above-1-to-the = Maps light above 1 to the range of the display
scene-tone-map = tone map
scene-encoding = Encoding
scene-conversion-of-linear-light-to-the = Conversion of linear light to the picture's values
scene-colour-encoding = colour encoding
scene-samples-3 = Samples
scene-samples-per-pixel-for-smooth-edges = Samples per pixel, for smooth edges
scene-samples-per-pixel = samples per pixel
scene-texture-filter-2 = Texture filter
scene-texture-filter = texture filter

## panels/probe/bars

scene-mirror-and-glass = mirror and glass
scene-bar-length-luminance = { $n }
    bar length: luminance

## panels/probe/lights

scene-corner-vertex-weight = Corner { $number }: vertex { $vertex }, weight { $weight }
scene-at-the-centroid-of-the-triangle = At the centroid of the triangle
scene-interpolated = Interpolated
scene-diffuse-light = diffuse light
scene-sum-of-diff-n-l-i = Sum of diff <N.L_i> L_i att_i spot_i
scene-specular-light = specular light
scene-sum-of-spec-i-l-i = Sum of spec_i L_i att_i spot_i
scene-cosine-of-the-angle-between-normal = Cosine of the angle between normal and light direction
scene-attenuation-with-distance = Attenuation with distance
scene-spot-cone-factor = Spot cone factor
scene-1-or-1-pi-in-the = 1, or 1/pi in the physical convention
scene-specular-factor-without-k-s = Specular factor, without k_s
scene-n-l-behind-the-surface = N.L { $cos_theta }: behind the surface
scene-to-the-light-world-space = To the light, world space
scene-l-mirrored-about-n = L mirrored about N
scene-halfway-between-l-and-v = Halfway between L and V
scene-incident-light-linear-rgb = Incident light, linear RGB
scene-world-space = World space
scene-the-normal-at-this-point = The normal at this point
scene-n-l-att-spot-spec = { $of }: N.L { $cos_theta }, att { $attenuation }, spot { $spot }, spec { $spec }
scene-diffuse = { $of } diffuse
scene-specular = { $of } specular

## panels/probe/mod

scene-preparing-the-cpu-reference-triangles = preparing the CPU reference: { $triangles } triangles
scene-point-at-the-picture-to-see = Point at the picture to see the light equation of that pixel in numbers. A click pins the pixel, Escape unpins it.
scene-the-environment = the environment
scene-the-background = the background
scene-this-pixel-shows = This pixel shows { $what }.
scene-the-light-equation-by-source = The light equation, by source
scene-light-by-source = Light by source
scene-the-light-equation-in-numbers = The light equation in numbers
scene-the-equation-in-numbers = The equation in numbers
scene-traced-light-by-the-way-it = Traced light, by the way it took
scene-the-first-paths-are-on-their = The first paths are on their way.
scene-a-click-pins-a-pixel-and = A click pins a pixel, and paths of light are followed through it.
scene-linear-rgb-mean-of-paths-through = linear RGB, mean of { $paths } paths through the pixel
scene-paths-through-the-pixel = paths through the pixel
scene-no-pixel = no pixel
scene-pixel = pixel { $x }, { $y }
scene-of-x-2 = of { $width } x { $height }
scene-unpin-the-pixel-escape = Unpin the pixel (Escape)
scene-click-in-the-picture-to-pin = Click in the picture to pin a pixel
scene-show-or-hide-the-lobe-at = Show or hide the lobe at a pinned pixel: the light that is reflected in each direction
scene-copy-all-numbers-as-json = Copy all numbers as JSON
scene-copy-as-text = Copy as text
scene-light-equation-by-the-cpu-reference = Light equation by the CPU reference in f64 at the pixel centre, linear RGB
scene-light-equation-by-opengl-with-one = Light equation by OpenGL with one sample, linear RGB
scene-rendering-equation-by-paths-through-the = Rendering equation by paths through the whole pixel, linear RGB
scene-largest-difference-of-cpu-and-opengl = largest difference of CPU and OpenGL { $difference }
scene-largest-difference = largest difference
scene-the-opengl-value-could-not-be = The OpenGL value could not be read
scene-of-x = { $x }, { $y } of { $width } x { $height }
scene-traced-2 = traced { $name }
scene-weights = { $triangle }, weights { $barycentrics }
scene-factors-2 = {"  "}factors
scene-diffuse-2 = {"  "}diffuse
scene-specular-2 = {"  "}specular

## panels/probe/sum

scene-terms-that-are-switched-off-count = Terms that are switched off count as 0; attenuation and spot count as 1.
scene-with-the-reflected-and-refracted-environment = with the reflected and refracted environment: { $r }  { $g }  { $b }

## panels/probe/surface

scene-surface = Surface
scene-the-shading-normal = The shading normal
scene-n-geometric = N geometric
scene-normal-of-the-triangle = Normal of the triangle
scene-to-the-eye = To the eye
scene-material-2 = Material { $material_name }
scene-edit-material-of-part = Edit the material of this part
scene-ambient = Ambient
scene-diffuse-textures-included = Diffuse, textures included
scene-specular-textures-included = Specular, textures included
scene-emitted = Emitted
scene-shininess-index-of-refraction = shininess { $shininess }   index of refraction { $refraction_index }
scene-part = , part { $part_name }
scene-of-vertices = { $triangle } of vertices { $a }, { $b }, { $c }
scene-back-n-flipped-towards-the-viewer = back, N flipped towards the viewer
scene-surfaces-visible-through-it = { $opacity }, { $behind } surfaces visible through it
scene-at = { $value }  at { $x }, { $y }
scene-environment-2 = Environment { $name }
scene-k-d-times-the-irradiance-about = k_d times the irradiance about N
scene-its-glossy-reflection = Its glossy reflection
scene-v-mirrored-about-n = V mirrored about N
scene-reflected-environment = Reflected environment
scene-refracted-environment = Refracted environment
scene-fresnel-reflectance-per-channel = Fresnel reflectance per channel
scene-no-fresnel = no Fresnel
scene-exact-fresnel = exact Fresnel
scene-schlick-s-fresnel = Schlick's Fresnel
scene-mirror-transmission = mirror { $share }   transmission { $transmission }   { $fresnel }

## panels/shaders

scene-your-shaders = Your shaders
scene-uniforms-2 = Uniforms
scene-none-no-program-has-been-compiled = None: no program has been compiled.
scene-the-program-has-none = The program has none.
scene-show-the-texts = Show the texts
scene-show-each-line-s-values-at = Show each line's values at a pixel: click on the picture, or press this for its middle (F9)
scene-close-your-shaders-gonio-s-own = Close your shaders: gonio's own draw the picture
scene-a-click-on-the-picture-shows = A click on the picture shows each line's values at that pixel.
scene-close-the-texts = Close the texts
scene-vertex = Vertex
scene-fragment = Fragment
scene-the-window-reads-the-file-again = The window reads the file again when it changes
scene-gonio-s-own = gonio's own
scene-compiled = Compiled.
scene-compiling = Compiling.
scene-these-texts-do-not-compile-the = These texts do not compile: the last program that did is drawn.
scene-these-texts-do-not-compile-gonio = These texts do not compile: gonio's own shaders draw the picture.
scene-state-of-your-shaders = state of your shaders
scene-show-the-line = Show the line
scene-choose-the-value = Choose the value
scene-back-to-gonio-s-value = Back to gonio's value
scene-as-it-is-shown-not-decoded = As it is shown: not decoded

## scene_view/arrangement

scene-divider-between-two-panes = divider between two panes
scene-the-difference-needs-both-pictures = the difference needs both pictures
scene-minus = { $second } minus { $first }
scene-difference-of-and = difference of { $first } and { $second }
scene-of-255 = of 255

## scene_view/axes

scene-look-along = Look along { $name }

## scene_view/drawing/comparison

scene-triangles-phong = { $count } triangles, Phong

## scene_view/gizmos/mod

scene-outside-of-the-picture-drag-to = {"   "}outside of the picture: drag to bring it in
scene-direction-of-the-light = direction of the light
scene-outer-angle-2 = outer angle
scene-light-2 = { $name } light { $index }

## scene_view/lobe/paint

scene-towards-v-of-the-peak = towards V { $value }, { $share } % of the peak

## scene_view/observer

scene-the-camera-and-its-frustum-from = the camera and its frustum from outside
scene-close-o = Close (O)
scene-rotate-automatically = Rotate automatically

## scene_view/pane

scene-picture-of-the-scene = picture of the scene

## scene_view/toolbar

scene-traced-truth = Traced (truth)
scene-solves-the-rendering-equation-by-following = Solves the rendering equation by following paths of light: shadows, light between surfaces and everything else that the light equation leaves out. It begins coarse and becomes finer while nothing changes.
scene-overlays-are-not-drawn-over-it-2 = Overlays are not drawn over it, and it has all triangles at any level of detail.
scene-overlays-are-not-drawn-over-it = Overlays are not drawn over it.
scene-view-of-the-scene-number-keys = View of the scene (number keys)
scene-first-light = first light
scene-light-3 = light { $light }
scene-wireframe-shift-w = Wireframe (Shift + W)
scene-normals-shift-n = Normals (Shift + N)
scene-up-axis = Up axis
scene-up-axis-tip = The axis of the model that points up: y in glTF, usually z in STL. F frames the object again
scene-ground-shift-g = Ground with a contact shadow (Shift + G). An aid: not part of the light equation, of saved pictures or of values
scene-bounding-boxes-shift-b = Bounding boxes (Shift + B)
scene-show-the-camera-and-its-frustum = Show the camera and its frustum from outside (O)
scene-probe-the-pixel-under-the-pointer = Probe the pixel under the pointer (P)

## states and titles

scene-picture = picture
scene-traced-picture = traced
scene-on = on
scene-off = off
scene-front = front
scene-back = back
scene-intensity-label = intensity
scene-unnamed = unnamed
scene-triangles-column = triangles
scene-vertices-column = vertices
scene-fragments-column = fragments
scene-shading-column = shading
scene-lit-column = lit
scene-equal = equal
scene-wireframe = wireframe
scene-normals-overlay = normals
scene-boxes = boxes
scene-simplifying = {" "}(simplifying)
scene-passes = { NUMBER($count) ->
    [one] { $count } pass
   *[other] { $count } passes
}
scene-draws = { NUMBER($count) ->
    [one] { $count } draw
   *[other] { $count } draws
}
scene-nothing = nothing
scene-triangles-drawn = { NUMBER($count) ->
    [one] { $count } triangle
   *[other] { $count } triangles
}
scene-if = {"   "}if{" "}
