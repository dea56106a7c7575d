# The panel of the environment, and the gallery.

## app/environment

environment-the-scene-has-no-environment-choose = the scene has no environment: choose one first
environment-saved-and-five-more-files = saved { $first } and five more files
environment-saved = saved { $first }
environment-the-environment-is-repaired = the environment is repaired

## environment/conversion

environment-the-environment-was-converted-already = the environment was converted already

## environment/mod

environment-the-study-of-the-environment-ended = The study of the environment ended early.
environment-the-conversion-of-the-environment-ended = the conversion of the environment ended early
environment-the-environment-could-not-be-repaired = the environment could not be repaired

## environment/panel

environment-openexr-linear-light-with-half-floats = OpenEXR: linear light with half floats
environment-radiance-linear-light-with-a-shared = Radiance: linear light with a shared exponent
environment-displayed-colours-with-the-exposure-and = Displayed colours, with the exposure and the tone map of the picture
environment-as-fine-as-the-environment = as fine as the environment
environment-no-detail-is-lost = No detail is lost
environment-faces-of-128-x-128-a = Faces of 128 x 128, a panorama of 512 x 256
environment-faces-of-256-x-256-a = Faces of 256 x 256, a panorama of 1024 x 512
environment-faces-of-512-x-512-a = Faces of 512 x 512, a panorama of 2048 x 1024
environment-faces-of-1024-x-1024-a = Faces of 1024 x 1024, a panorama of 4096 x 2048
environment-faces-of-2048-x-2048-a = Faces of 2048 x 2048, a panorama of 8192 x 4096
environment-as-texture-samplercube-direction-expects-an = As texture(samplerCube, direction) expects; an image viewer shows the faces mirrored
environment-the-faces-look-right-in-an = The faces look right in an image viewer
environment-environment = Environment
environment-close-the-environment-panel = Close the environment panel
environment-open-a-panorama-a-cross-a = Open a panorama, a cross, a strip, a KTX2 or DDS cubemap, or six faces; dropping them works too
environment-the-scene-has-no-environment-choose-2 = The scene has no environment. Choose one above, or drop a panorama or six faces on the window.
environment-reading-the-environment = Reading the environment...
environment-this-repaired-environment-only-exists-in = This repaired environment only exists in the window: save it to keep it.
environment-convert-and-save = Convert and save
environment-built-in = Built in
environment-panorama = Panorama
environment-horizontal-cross = Horizontal cross
environment-vertical-cross = Vertical cross
environment-horizontal-strip = Horizontal strip
environment-vertical-strip = Vertical strip
environment-cubemap-in-one-file = Cubemap in one file
environment-six-files = Six files
environment-came-as-2 = Came as
environment-the-arrangement-of-the-environment-in = The arrangement of the environment in its files
environment-came-as = came as
environment-form = Form
environment-size-of-the-faces-or-of = Size of the faces or of the panorama, and the layout in which the faces are read
environment-orientation = Orientation
environment-puts-every-face-in-its-place = Puts every face in its place; no texel changes. The step can be undone.
environment-repair = Repair
environment-format = Format
environment-the-format-of-pictures-ktx2-has = The format of pictures; KTX2 has its own
environment-format-of-pictures = format of pictures
environment-size = Size
environment-texels-along-an-edge-of-a = Texels along an edge of a face; a panorama is four times as wide
environment-layout = Layout
environment-the-layout-of-the-faces-in = The layout of the faces in the files
environment-layout-of-faces = layout of faces
environment-a-png-holds-displayed-colours-light = A PNG holds displayed colours: light above 1 is lost.
environment-converting-the-environment = Converting the environment...
environment-posx-to-negz-six-pictures-in = posx to negz, six pictures in one zip file
environment-the-unfolded-cube-in-one-picture = The unfolded cube in one picture, 4 by 3 faces
environment-one-picture-twice-as-wide-as = One picture, twice as wide as high
environment-a-cubemap-with-its-mip-levels = A cubemap with its mip levels, in OpenGL's layout
environment-six-pictures-sky-exr-is-saved = Six pictures: sky.exr is saved as sky_posx.exr to sky_negz.exr

## environment/pictures

environment-environment-face = environment face
environment-environment-panorama = environment panorama
environment-face-x-to-the-right = Face +X, to the right
environment-face-x-to-the-left = Face -X, to the left
environment-face-y-above = Face +Y, above
environment-face-y-below = Face -Y, below
environment-face-z-behind = Face +Z, behind
environment-face-z-straight-ahead = Face -Z, straight ahead
environment-panorama-360-degrees-from-left-to = Panorama: 360 degrees from left to right, straight ahead in the middle

## environment/product

environment-six-faces-zip = Six faces (ZIP)
environment-six-faces = Six faces
environment-cross = Cross
environment-strip = Strip

## environment/study

environment-the-environment-was-studied-already = the environment was studied already

## gallery/mod

environment-the-light-equation = The light equation
environment-back-to-the-scene = Back to the scene
environment-gallery = Gallery
environment-light-or-dark-theme-t = Light or dark theme (T)

## gallery/thumbnails

environment-the-scene-could-not-be-loaded = the scene { $name } could not be loaded
environment-the-scene-is-not-in-the = the scene { $name } is not in the gallery

## panels/messages

environment-show-line-of-the-file = Show line { $line } of the file

## panels/picture

environment-faces-and-conversion = Faces and conversion
environment-the-environment-as-six-faces-and = The environment as six faces and as a panorama, the check of its orientation, and its conversion
