# bench

## baking/mod

bench-the-baked-atlas-could-not-be = the baked atlas could not be shown: its preparation failed

## baking/panel

bench-256-x-256-texels = 256 x 256 texels
bench-512-x-512-texels = 512 x 512 texels
bench-1024-x-1024-texels = 1024 x 1024 texels
bench-2048-x-2048-texels = 2048 x 2048 texels
bench-4096-x-4096-texels-64-mb = 4096 x 4096 texels: 64 MB for each map while it is shown
bench-one-is-enough-for-textures-which = One is enough for textures, which are filtered
bench-four-samples-of-each-texel-smooth = Four samples of each texel smooth the borders of materials and shadows
bench-nine-samples-of-each-texel = Nine samples of each texel
bench-sixteen-samples-of-each-texel = Sixteen samples of each texel
bench-unwrap = Unwrap
bench-new-texture-coordinates-charts-without-overlaps = New texture coordinates: charts without overlaps, packed into one square
bench-repack = Repack
bench-the-model-s-own-charts-packed = The model's own charts, packed again with equal density
bench-keep-uvs = Keep UVs
bench-the-model-s-own-texture-coordinates = The model's own texture coordinates, which must not overlap
bench-original = Original
bench-the-scene-s-own-materials = The scene's own materials
bench-baked = Baked
bench-the-materials-of-the-baked-model = The materials of the baked model, lit by the scene's lights
bench-picture = Picture
bench-the-picture-that-the-atlas-shows = The picture that the atlas shows, without any light: a map, the charts or the checker
bench-the-diffuse-colour-k-d-with = The diffuse colour k_d with its texture and vertex colours
bench-the-specular-colour-k-s-with = The specular colour k_s with its texture
bench-the-normal-in-tangent-space-mikktspace = The normal in tangent space (MikkTSpace), green up
bench-the-share-of-the-hemisphere-that = The share of the hemisphere that no surface covers
bench-the-scene-s-light-on-the = The scene's light on the surface, linear (OpenEXR)
bench-the-position-in-world-space-openexr = The position in world space (OpenEXR)
bench-the-emitted-light-e-with-its = The emitted light E with its texture
bench-a-colour-for-each-part-of = A colour for each part of each object
bench-the-scene-has-changed-since-bake = The scene has changed since: bake again to update the textures.
bench-settings = Settings
bench-what-is-baked-and-how = What is baked, and how
bench-the-charts-over-the-baked-maps = The charts over the baked maps
bench-page = Page
bench-close-the-atlas-and-the-settings = Close the atlas and the settings of baking
bench-texture = Texture
bench-the-texture-coordinates-to-bake-for = The texture coordinates to bake for
bench-layout = Layout
bench-the-model-has-no-texture-coordinates = The model has no texture coordinates to keep.
bench-texels-along-a-side = Texels along a side
bench-size = Size
bench-samples-of-each-texel = Samples of each texel
bench-samples = Samples
bench-the-distance-between-charts-as-a = The distance between charts, as a share of the side
bench-texels = { $count } texels
bench-rays-of-each-texel-for-ambient = Rays of each texel for ambient occlusion
bench-rays = Rays
bench-bake-again = Bake again
bench-bake-textures = Bake textures
bench-there-is-no-triangle-to-bake = There is no triangle to bake.
bench-choose-at-least-one-map = Choose at least one map.
bench-triangles = { $count } triangles
bench-error = Error
bench-preparing-the-atlas = preparing the atlas
bench-about = , about { $left }
bench-cancel = Cancel
bench-progress = Progress
bench-s-left = { $seconds } s left
bench-min-left = { $seconds } min left
bench-on-the-model = On the model
bench-wipe = Wipe
bench-the-original-and-the-baked-model = The original and the baked model on top of each other, with a divider to drag
bench-difference = Difference
bench-colour-map-of-the-difference-between = Colour map of the difference between the original and the baked model
bench-one-picture = One picture
bench-a-single-pane-again = A single pane again
bench-baked-in-s = Baked in { $seconds } s
bench-time = Time
bench-save-2 = Save
bench-the-model-as-obj-and-mtl = The model as .obj and .mtl, with its maps and the layout beside it
bench-one-file-with-the-model-and = One file with the model and the maps that its materials use
bench-all-files-in-one-obj-mtl = All files in one: .obj, .mtl, .glb, the maps and the layout
bench-save = Save { $title }
bench-atlas = Atlas
bake-charts = Charts
bench-connected-pieces-of-the-surface = Connected pieces of the surface
bake-coverage = Coverage
bench-the-share-of-the-texture-that = The share of the texture that triangles cover
bake-overlaps = Overlaps
bench-texels-that-two-or-more-triangles = Texels that two or more triangles cover
bake-angle-stretch = Angle stretch
bench-1-keeps-all-angles = 1 keeps all angles
bake-area-stretch = Area stretch
bench-1-keeps-all-areas = 1 keeps all areas
bake-density = Density
bench-texels-per-unit = { $texels_per_unit } texels per unit
bench-texels-per-unit-of-length-in = Texels per unit of length in world space
bench-margin = Margin
bench-the-distance-between-charts = The distance between charts
bake-degenerate = Degenerate
bake-collapsed = Collapsed
bake-mirrored = Mirrored

## baking/view

bench-texture-atlas = texture atlas, { $background }
bench-each-chart-in-a-colour-of = Each chart in a colour of its own, with its triangles
bench-checker = Checker
bench-squares-with-picture-on-the-model = Squares: with "Picture" on the model they show its stretch
bench-picture-of-the-atlas = Picture of the atlas
bench-show-the-whole-atlas = Show the whole atlas
bench-zoom-out = Zoom out
bench-zoom-in = Zoom in
bench-outline-the-charts = Outline the charts
bench-point-at-a-chart-its-place = Point at a chart: its place on the model is marked. A click keeps it.
bench-marked-texel = Marked texel
bench-of = {" "}of { $name }
bench-texel-chart = Texel { $column }, { $row }, chart { $chart }{ $object }

## bench/checks

bench-checks = Checks
bench-check = Check
bench-reciprocity-energy-positivity-normalisation-and-chi = Reciprocity, energy, positivity; normalisation and chi-square of the samples
bench-below = Below: { $name }

## bench/functions

bench-was-not-added-the-bench-holds = `{ $name }` was not added: the bench holds { $MOST_FUNCTIONS } functions, remove one first
bench-a-file-could-not-be-read = a file could not be read: the reader ended unexpectedly

## bench/list

bench-add-a-model-or-open-a = Add a model, or open a .binary, .brdf or .glsl file; you can also drop files here.
bench-show-or-hide-the-parameters = Show or hide the parameters
bench-click-check-this-function = { $title }
    Click: check this function
bench-remove-this-function = Remove this function
bench-shown-hide-it = Shown: hide it
bench-hidden-show-it = Hidden: show it
bench-no-parameters = no parameters

## bench/mod

bench-bench-page = bench page
bench-plot = Plot
bench-functions = Functions

## bench/paint

bench-bench-picture = bench picture

## bench/plot

bench-the-computation-ended-unexpectedly = the computation ended unexpectedly
bench-plot-of-light-at-degrees = { $name } plot of { $functions }, light at { $degrees } degrees
bench-no-function-is-shown-add-a = No function is shown: add a model, or open a .binary, .brdf or .glsl file.

## bench/settings

bench-scale-of-the-values = Scale of the values
bench-scale = Scale
bench-angle-along-the-horizontal-axis = Angle along the horizontal axis
bench-over = Over
bench-angle-of-the-viewer-from-the = Angle of the viewer from the normal
bench-angle-between-light-and-viewer = Angle between light and viewer
bench-angle-of-incidence-between-light-and = Angle of incidence, between light and normal
bench-incidence = Incidence
bench-azimuth-of-the-light-from-the = Azimuth of the light from the tangent, for anisotropic functions
bench-azimuth = Azimuth
bench-plot-f-cos-angle-of-incidence = Plot f cos(angle of incidence), the reflected radiance for a light of irradiance 1 across its rays
bench-times-cosine = times cosine

## bench/toolbar

bench-back-to-the-scene = Back to the scene
bench-brdf-bench = BRDF bench
bench-add-a-model = Add a model
bench-models-of-reflection-and-transmission = Models of reflection and transmission
bench-open-binary-merl-brdf-or-glsl = Open .binary (MERL), .brdf or .glsl files, or .toml of fits (Ctrl + O); you can also drop them here
bench-save-the-plot = Save the plot
bench-light-or-dark-theme = Light or dark theme

## stations/controls

bench-parameters = Parameters
bench-stop-the-film = Stop the film
bench-play-a-film-of-this-parameter = Play a film of this parameter

## stations/law

bench-the-law-of = The law of { $title }
bench-checks-of-the-law = Checks of the law
bench-computed-after-the-picture-s-beginning = computed after the picture's beginning
bench-law-found = law { $expected }   found { $measured }   ± { $bound } { $unit }

## stations/mod

bench-the-stations-cannot-be-loaded = The stations cannot be loaded.
bench-loading-the-stations = Loading the stations...
bench-the-link-names-an-unknown-station = the link names an unknown station `{ $name }`
bench-the-link-is-damaged = the link is damaged: { $error }
bench-copy-a-link-to-this-station = Copy a link to this station
bench-beyond-the-rendering-equation = Beyond the rendering equation
bench-station-page = station page
bench-stations = Stations
bench-sliders = Sliders
bench-text = Text
bench-law = Law

## stations/page

bench-the-rendering-equation-assumes = The rendering equation assumes
bench-in-nature = In nature
bench-look = Look
bench-question = Question
bench-the-law = The law
bench-source = Source: { $source }

## stations/picture

bench-continue-to-refine-the-picture = Continue to refine the picture
bench-stop-refining-the-picture = Stop refining the picture
bench-1-sample = 1 sample
bench-samples-done = { $samples } samples, done
bench-samples-2 = { $samples } samples
bench-samples-of-each-pixel = Samples of each pixel

## short words

bench-holds = holds
bench-fails = fails
bench-pass = pass
bench-fail = fail
bench-charts-word = charts
bench-checker-word = checker
