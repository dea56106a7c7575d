# The panel of files.

## app/inspector

file-no-model-is-chosen-choose-one = no model is chosen: choose one in the File tab
file-saved = saved { $place }
file-belongs-to-the-open-scene-and = `{ $own }` belongs to the open scene and would be replaced: save under another name

## inspector

file-the-work-ended-unexpectedly-this-is = the work ended unexpectedly; this is a bug, please report it
file-cannot-be-written = `{ $place }` cannot be written: { $error }

## panels/file/contents

file-unpacked = { $name }, { $bytes }, { $unpacked } unpacked
file-format = Format
file-content = Content
file-exporter = Exporter
file-elements = Elements
file-parts = Parts
file-no-name = (no name)
file-the-default-material = the default material
file-triangles-2 = { $count } triangles, { $material }
file-triangles = Triangles
file-vertices = Vertices
file-equal-corners-merged = { $count } (equal corners merged)
file-bounds = Bounds
file-from-to-size = { $name } from { $low } to { $high }, size { $size }
file-from-the-file = from the file
file-from-the-file-averaged-where-missing = from the file, averaged where missing
file-one-per-triangle = one per triangle
file-averaged-over-adjacent-faces-weighted-by = averaged over adjacent faces, weighted by angle
file-normals = Normals
file-to = { $least } to { $greatest }
file-texture-coordinates = Texture coordinates
file-vertex-colours = Vertex colours
file-off-everywhere = off everywhere
file-smoothing-groups = Smoothing groups
file-memory = Memory
file-closed-front-faces-outside = closed, front faces outside
file-closed-but-not-every-piece-has = closed, but not every piece has its front faces outside
file-surface = Surface
file-pieces = Pieces
file-genus = Genus
file-area = Area
file-volume = Volume
file-no-choice-of-front-faces-is = no choice of front faces is consistent
file-orientation = Orientation
file-triangles-must-be-flipped-to-make = { $count } triangles must be flipped to make all front faces consistent
file-triangles-without-area = Triangles without area
file-duplicate-triangles = Duplicate triangles
file-triangles-back-to-back = Triangles back to back
file-edges-of-one-triangle-only = Edges of one triangle only
file-edges-of-more-than-two-triangles = Edges of more than two triangles
file-edges-between-a-front-and-a = Edges between a front and a back face
file-points-where-surfaces-merely-touch = Points where surfaces merely touch
file-the-first-at = { $count }, the first at { $place }
file-lights-and-cameras = Lights and cameras
file-ambient-light = ambient light
file-directional-light = directional light
file-point-light = point light
file-spot-light = spot light
file-colour-intensity = { $kind }, colour { $color }, intensity { $intensity }
file-camera-high = camera, { $degrees }° high
file-camera-with-parallel-projection = camera with parallel projection
file-interpreted-differently-by-other-programs = Interpreted differently by other programs
file-elsewhere = Elsewhere: { $others }
file-here = Here: { $here }
file-bytes = { $count } bytes
file-kb = { $size } kB
file-mb = { $size } MB
file-gb = { $size } GB

## panels/file/lines

file-close-the-text = Close the text
file-next-line = Next line
file-previous-line = Previous line
file-number-of-the-marked-line = Number of the marked line
file-lines = { $file }, { $count } lines
file-line-2 = line { $line }
file-line = { $file }, line { $marked }: { $text }

## panels/file/materials

file-materials = Materials
file-triangles-3 = { $name }, { $count } triangles
file-not-used = not used

## panels/file/mod

file-no-file-is-open = No file is open.
file-the-file-is-being-read = The file is being read...
file-file = File
file-missing = { $name } ({ $lacks } missing)
file-the-model-as-its-file-has = The model as its file has it, without changes that were made in the scene
file-save-as = Save as
file-one-file-with-the-model-its = One file with the model, its materials and textures
file-the-model-as-obj-with-its-2 = The model as .obj with its .mtl and textures, packed as a ZIP file
file-the-model-as-obj-with-its = The model as .obj, with its .mtl and textures beside it
file-vertices-triangles-and-vertex-colours-ply = Vertices, triangles and vertex colours; PLY has no materials
file-save-the-model-as = Save the model as { $title }
file-the-model-is-being-converted = The model is being converted...
file-warnings-and-notes = Warnings and notes
file-line-3 = { $name }, line { $line }
file-show-line-of = Show line { $line } of { $name }
file-more-are-not-shown-gonio-inspect = { $count } more are not shown; `gonio inspect --json` lists all.

## panels/file/names

file-the-textures-are-inside-the-model = The textures are inside the model's file.
file-the-file-that-the-model-names-2 = The file that the model names was found.
file-all-files-that-the-model-names = All { $all } files that the model names were found.
file-the-file-that-the-model-names = The file that the model names is missing.
file-one-of-files-that-the-model = One of { $all } files that the model names is missing.
file-of-files-that-the-model-names = { $absent } of { $all } files that the model names are missing.
file-inside-the-file = inside the file, { $size }
file-drop-the-missing-files-on-the = Drop the missing files on the window, or choose them: they are found by their names, in whatever folder the model looks for them.
file-choose-files = Choose files...
file-of-x-texels = { $key } of { $material }, { $width } x { $height } texels
file-of = { $key } of { $material }
file-not-read-2 = not read
file-found-as = Found as { $path }
file-not-read = Not read: { $refused }
file-missing-there-is-no-folder-to = Missing; there is no folder to search
file-missing-searched = Missing; searched { $folders }
file-show-the-text = Show the text
file-files = Files
file-model-of-one-object = model of one object
file-model-of-objects = model of { $objects } objects
file-files-that-it-names-and-that = Files that it names and that are missing: { $lacks }
file-show-its-content = Show its content
file-brdf-of-an-object = BRDF of an object
