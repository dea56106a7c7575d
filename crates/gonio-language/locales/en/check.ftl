# check

## check/by_values

check-no-attribute-looks-like-the-position = no attribute looks like the position: name it `position`, or assign its role in names.toml
check-the-output-is-not-the-vertex = the output is not the vertex colour (`color`), so only positions were compared, which is what this exercise is about; the pictures show distances
check-the-lookup-is-right-in-every = the lookup is right in every scene; its colour is changed afterwards
check-the-colour-of-the-cubemap-is-2 = The colour of the cubemap is mixed with other colours; the pictures show the lookup alone
check-the-colour-of-the-cubemap-is = the colour of the cubemap is mixed with other colours; only the lookup was judged, and the pictures show it
check-the-diffuse-light-is-drawn-in = The diffuse light is drawn in steps (toon shading)
check-all-but-one-of-the-object = all but one of the object's colours are white
check-right-in-every-test-scene-provided = right in every test scene, provided that { $join }
check-right-in-every-scene = right in every scene
check-right-in-every-scene-by-another = right in every scene, by another method
check-the-picture-differs-from-the-reference = the picture differs from the reference, but the meaning of { $join } is unknown: state it in names.toml
check-no-known-mistake-explains-the-difference = no known mistake explains the difference from the reference in: { $join }
check-the-program-sends-without-its-translation = the program sends `{ $name }` without its translation
check-is = `{ $name }` is `{ $role }`
check-with-this-value-every-test-scene = With this value every test scene is right.

## check/corrections

check-nothing-is-drawn-check-the-value = nothing is drawn: check the value of gl_Position
check-the-picture-is-black-in-every = the picture is black in every scene: look for a vector, colour or strength that is 0 and should not be
check-every-pixel-is-nan-in-every = every pixel is NaN in every scene: look for 0 divided by 0, or for a vector of length 0 that is normalised
check-the-picture-has-a-single-colour = the picture has a single colour in every scene: no term depends on the position or the normal

## check/mod

check-cannot-be-checked-yet = { $id } cannot be checked yet
check-the-picture-is-right-here-only = { $name }; the picture is right here only by chance
check-these-are-the-unchanged-start-files-2 = these are the unchanged start files; { $name }
check-these-are-the-unchanged-start-files = these are the unchanged start files
check-right-by-the-standard-of-the = right by the standard of the lab's own solutions

## comparison/conclusion

check-pixels-are-nan-or-infinite-look = { $undefined } pixels are NaN or infinite: look for a division by 0, or a square root or power of a negative number
check-the-light-is-computed-for-each = The light is computed for each vertex (Gouraud shading)

## comparison/mod

check-a-loop-in-a-shader-never = a loop in a shader never ends

## feedback

check-a-value-is-wrong-in-a = A value is wrong, in a way that is in no list
check-the-answer-is-not-right = the answer is not right
check-of-test-scenes-are-right = { $right } of { $all } test scenes are right

## proposed_fix

check-with-this-change-every-test-scene = With this change every test scene is right.
check-with-these-changes-every-test-scene = With these changes every test scene is right.

## source/analysis

check-pow-of-a-negative-number-is = `pow` of a negative number is undefined: move `max` inside, `pow(max(dot(R, V), 0.0), shininess)`
check-with-mipmaps-a-seam-would-appear = with mipmaps a seam would appear behind the camera, where u jumps from 1 to 0; `textureLod(panorama, place, 0.0)` avoids it

## verdict

check-the-check-did-not-finish-within = the check did not finish within { $seconds } seconds; is there a loop in a shader that never ends?
check-the-check-crashed-the-graphics-driver = the check crashed: the graphics driver here cannot compile or run this shader
check-the-check-was-stopped-because-it = the check was stopped because it took more than a gigabyte of memory; is there a giant array?

## compile

check-compiler-other-compilers-may-reject-it = { $file }:{ $line }: { $message }; other compilers may reject it

## driver_log/mod

check-compiler-did-you-mean = Did you mean `{ $word }`?
check-compiler-line-ends-without-a-semicolon = Line { $line } ends without a semicolon: `{ $code }`.

## panorama/mod

check-panorama-the-shaders-do-not-read-a = the shaders do not read a panorama: declare `uniform sampler2D panorama;`
check-panorama-face-shows-what-belongs-on = Face { $face } shows what belongs on { $shown }
check-panorama-the-order-of-opengl-s-faces = The order of OpenGL's faces is +X, -X, +Y, -Y, +Z, -Z.
check-panorama-all-six-faces-are-right = all six faces are right
check-panorama-no-face-is-right-and-no = no face is right, and no known mistake explains the faces
check-panorama-no-known-mistake-explains-the = no known mistake explains the { $s } { $unexplained }
check-panorama-they-have-of-the-panorama-s = { $name }: they have { $sharpness } % of the panorama's sharpness

## submission/choose

check-submission-line = { $file } line { $place }
check-submission-there-are-several-shaders-and-were = there are several shaders: { $all }; { $shown } and { $shown2 } were checked. If that is the wrong pair, hand in only the right one, or name it.

## submission/mod

check-submission-inserts-values-into-with-gonio-left = { $name } inserts values into `{ $variable }` with ${"{"}...{"}"}; gonio left them out.
check-submission-neither-the-name-nor-the-content = neither the name nor the content of { $name } shows its stage: taken as the { $stage } shader.
check-submission-is-named-like-a-vertex-shader = { $file } is named like a vertex shader, but outputs a colour and no gl_Position: taken as the fragment shader. Rename it.

## submission/stage

check-submission-what-only-a-fragment-shader-has = what only a fragment shader has
check-submission-is-named-like-a-shader-but = { $shown } is named like a { $named } shader, but holds { $because }: taken as the { $content } shader. Rename it.

## submission/text

check-submission-begins-with-a-byte-order-mark = { $file } begins with a byte order mark, which some compilers reject; gonio ignored it. Save the file as UTF-8 without BOM.
check-submission-is-utf-16-which-no-glsl = { $file } is UTF-16, which no GLSL compiler reads; gonio converted it. Save the file as UTF-8.
check-submission-broken-utf-16 = broken UTF-16
check-submission-zeros-in-utf-16-text = zeros in UTF-16 text
check-submission-a-zero-byte-at-offset = a zero byte at offset { $offset }
check-submission-invalid-utf-8-at-offset = invalid UTF-8 at offset { $valid_up_to }
check-submission-is-not-utf-8-gonio-read = { $file } is not UTF-8; gonio read it as Latin-1. Save the file as UTF-8, or write comments without accents.

## roles/file

check-inputs-names-toml-line = names.toml, line { $line }: { $message }
check-inputs-must-be-a-list-of-1 = `{ $name }` must be a list of 1 to 16 numbers, such as [1.0, 0.5, 0.0]
check-inputs-must-be-a-role-such-as = `{ $name }` must be a role such as "light-pos", a number or a list of numbers

## roles/mod

check-inputs-by-its-name = by its name
check-inputs-by-its-type = by its type
check-inputs-by-its-name-and-its-neighbours = by its name and its neighbours
check-inputs-by-names-toml = by names.toml

## roles/role

check-inputs-unknown-role-did-you-mean = unknown role `{ $word }`: did you mean `{ $nearest }`?

## user_shaders/inputs

check-inputs-the-first-light-s = the first light's { $what }
check-inputs-the-second-light-s = the second light's { $what }
check-inputs-light-s = light { $more }'s { $what }
check-inputs-the-object-s-matrix-m = the object's matrix M
check-inputs-the-camera-s-matrix-v = the camera's matrix V
check-inputs-the-camera-s-matrix-p = the camera's matrix P
check-inputs-v-m-of-object-and-camera = V M of object and camera
check-inputs-the-camera-s-p-v = the camera's P V
check-inputs-p-v-m-of-object-and = P V M of object and camera
check-inputs-the-object-s-inverse-transpose-of = the object's inverse transpose of M
check-inputs-the-inverse-transpose-of-v-m = the inverse transpose of V M
check-inputs-the-inverse-of-the-object-s = the inverse of the object's matrix M
check-inputs-the-inverse-of-the-camera-s = the inverse of the camera's matrix V
check-inputs-the-inverse-of-v-m = the inverse of V M
check-inputs-the-camera-s-matrix-v-without = the camera's matrix V without its translation
check-inputs-the-camera-s-p-v-without = the camera's P V without the translation
check-inputs-from-the-camera = from the camera
check-inputs-from-the-camera-in-degrees = from the camera, in degrees
check-inputs-position-in-view-space = position in view space
check-inputs-direction-in-view-space = direction in view space
check-inputs-half-vector = half vector
check-inputs-the-ambient-light = the ambient light
check-inputs-the-number-of-lights = the number of lights
check-inputs-the-time-in-seconds = the time in seconds
check-inputs-the-picture-s-size-in-pixels = the picture's size in pixels
check-inputs-from-the-material = from the material

## user_shaders/mod

check-inputs-there-is-neither-a-vertex-nor = there is neither a vertex nor a fragment shader

## user_shaders/names

check-inputs-the-file-is-not-text-in = { $name }:{ $line }: the file is not text in UTF-8

## user_shaders/stand_in

check-inputs-gonio-s-vertex-shader = gonio's vertex shader
check-inputs-gonio-s-fragment-shader = gonio's fragment shader
check-inputs-gonio-s-vertex-shader-does-not = { $file }:{ $line }:{ $column }: gonio's vertex shader does not know what `{ $name }` is, and writes 0; give it a name such as `world_position`, `normal`, `uv` or `color` or a role in names.toml, or add a vertex shader

## user_shaders/uniforms

check-inputs-1-number = 1 number
check-inputs-numbers = { $expected } numbers
check-inputs-is-a-and-takes-not = `{ $name }` is a { $glsl_type } and takes { $numbers }, not { $given }
check-inputs-its-initialiser = its initialiser
check-inputs-your-value = your value
check-inputs-not-recognised-a-guess = not recognised: a guess
check-inputs-invalid-uniform-expected-name-value-value = invalid uniform `{ $text }`: expected NAME=VALUE[,VALUE...], for example scale=2 or tint=1,0.5,0
check-inputs-invalid-value-of-the-uniform-expected = invalid value `{ $word }` of the uniform `{ $name }`: expected a number, true, false or #rrggbb

## user_shaders/user_inputs

check-inputs-has-no-effect-on-the-picture = has no effect on the picture
check-inputs-is-not-in-the-shaders = is not in the shaders
check-inputs-the-uniform-has-no-effect-on = the uniform `{ $name }` has no effect on the picture, so its value is ignored
check-inputs-is-a-sampler-texture-gives-it = `{ $name }` is a sampler; --texture gives it a picture
check-inputs-the-shaders-have-no-uniform-did = the shaders have no uniform `{ $name }`; did you mean `{ $near }`?
check-inputs-the-shaders-have-no-uniform-nor = the shaders have no uniform `{ $name }`, nor any other
check-inputs-the-shaders-have-no-uniform-they = the shaders have no uniform `{ $name }`; they have { $join }
check-inputs-the-shaders-have-no-sampler-did = the shaders have no sampler `{ $name }`; did you mean `{ $near }`?
check-inputs-the-shaders-have-no-sampler-nor = the shaders have no sampler `{ $name }`, nor any other
check-inputs-the-shaders-have-no-sampler-they = the shaders have no sampler `{ $name }`; they have { $join }
check-inputs-the-material-s-colour-texture = the material's colour texture
check-inputs-the-material-s-specular-texture = the material's specular texture
check-inputs-the-material-s-normal-map = the material's normal map
check-inputs-the-environment = the environment
check-inputs-your-picture = your picture
check-inputs-not-recognised-white = not recognised: white
check-inputs-the-model-has-no-texture-coordinates = the model has no texture coordinates; the shaders read 0 instead
check-inputs-the-scene-has-no-environment-the = the scene has no environment; the shaders read a black cubemap, and --environment gives them one
check-inputs-the-scene-has-no-light-the = the scene has no light; the shaders read a white one at the camera
check-inputs-the-model-has-no-colour-texture = the model has no colour texture; the shaders read white instead
check-inputs-is-an-attribute-which-takes-a = `{ $name }` is an attribute, which takes a role such as "position", not a value
check-inputs-is-a-sampler-which-takes-a = `{ $name }` is a sampler, which takes a role such as "diffuse-texture", not a value
check-inputs-numbers-2 = { $all } numbers
check-inputs-is-a-and-takes-not-2 = `{ $name }` is a { $ty } and takes { $numbers }, not { $count }
check-inputs-an-attribute = an attribute
check-inputs-a-sampler = a sampler
check-inputs-a-uniform = a uniform
check-inputs-is-which-cannot-have-the-role = `{ $name }` is { $what }, which cannot have the role `{ $role }`
check-inputs-the-attribute-is-not-recognised-and = the attribute `{ $name }` is not recognised and reads 0, 0, 0, 1; names such as `position` are, and names.toml gives it a role
check-inputs-the-sampler-reads-white-texture-gives = the sampler `{ $name }` reads white; --texture gives it a picture
check-inputs-the-sampler-reads-0-gonio-has = the sampler `{ $name }` reads 0: gonio has no texture for { $other }

## Quantities of the light equation, with their articles

check-quantity-position = the position
check-quantity-position-in-model-space = the position in model space
check-quantity-normal = the normal
check-quantity-unit-normal = the unit normal
check-quantity-vector-to-light = the vector from the surface to the light
check-quantity-direction-to-light = the unit direction from the surface to the light
check-quantity-direction-from-light = the unit direction from the light to the surface
check-quantity-vector-to-eye = the vector from the surface to the eye
check-quantity-direction-to-eye = the unit direction from the surface to the eye
check-quantity-vector-from-eye = the vector from the eye to the surface
check-quantity-direction-from-eye = the unit direction from the eye to the surface
check-quantity-reflected-or-refracted-direction = the reflected or refracted direction
check-quantity-looked-up-direction = the direction to look up in the cubemap
check-quantity-unit-half-vector = the unit half vector
check-quantity-sum-of-directions = the sum of the directions to the light and to the eye
check-quantity-cosine-of-light = the cosine between normal and light
check-quantity-cosine-of-eye = the cosine between normal and eye
check-quantity-cosine-of-half-vector = the cosine between normal and half vector
check-quantity-cosine-of-reflection = the cosine between reflected direction and eye
check-quantity-sum-of-terms = the sum of the diffuse and the specular term
check-quantity-cosine-clamped = the cosine between normal and light, at least 0
check-quantity-highlight-cosine = the cosine of the highlight
check-quantity-highlight-cosine-clamped = the cosine of the highlight, at least 0
check-quantity-highlight = the cosine of the highlight to the power of the shininess
check-quantity-distance-to-light = the distance from the surface to the light
check-quantity-attenuation = the attenuation
check-quantity-ambient-term = the ambient term
check-quantity-diffuse-term = the diffuse term
check-quantity-specular-term = the specular term
check-quantity-diffuse-attenuated = the diffuse term times the attenuation
check-quantity-specular-attenuated = the specular term times the attenuation
check-quantity-attenuated-sum = the sum of diffuse and specular light, attenuated
check-quantity-sum-of-all-terms = the sum of all terms
check-quantity-coloured-sum = the sum of all terms times the material's colour
check-quantity-right-colour = the colour of the right answer
check-quantity-cubemap-colour = the colour of the cubemap in the right direction
check-quantity-position-on-screen = the position on the screen: P V M times the position
check-quantity-position-of-the-light = the position of the light
check-quantity-position-of-the-eye = the position of the eye
check-quantity-material-s-colour = the material's colour
check-quantity-ambient-strength = the ambient strength
check-quantity-diffuse-strength = the diffuse strength
check-quantity-specular-strength = the specular strength
check-quantity-attenuation-constant = the constant of the attenuation
check-quantity-attenuation-linear = the linear constant of the attenuation
check-quantity-attenuation-quadratic = the quadratic constant of the attenuation
check-quantity-shininess = the shininess
check-quantity-roughness = the roughness
check-quantity-pi = pi
check-quantity-squared-tangent = the squared tangent of the angle between normal and half vector
check-quantity-tangent = the tangent of the angle between normal and half vector
check-quantity-angle = the angle between normal and half vector
check-quantity-square-of-the-roughness = the square of the roughness
check-quantity-exponent-of-ward = the exponent of Ward's model
check-quantity-normalisation-of-ward = the normalisation of Ward's model, 4 pi alpha^2
check-quantity-divisor-of-ward = the normalisation of Ward's model times the root of the cosines
check-quantity-exponential-of-ward = the exponential of Ward's model
check-quantity-root-of-cosines = the root of the cosines of light and eye
check-quantity-diffuse-brdf = the diffuse BRDF
check-quantity-ward-s-specular-brdf = Ward's specular BRDF
check-quantity-sum-of-brdfs = the sum of the diffuse and the specular BRDF
check-quantity-irradiance = the light of the lamp that the surface receives
check-quantity-ward-without-strength = Ward's specular BRDF without its strength
check-quantity-index-of-refraction = the index of refraction
check-quantity-ratio-of-indices = the ratio of the indices of refraction
check-quantity-product = { $product } times { $factor }
check-quantity-in-view-space = { $quantity }, in view space
check-quantity-interpolated = { $quantity }, interpolated

## What an expression should be: the expression, in code, precedes it

check-should-be = should be { $quantity }
check-should-have-the-other-sign = should have the other sign
check-should-be-normalised = should be normalised
check-should-be-at-least-zero = should be at least 0
check-should-be-linear = should not be raised to 1 / 2.2
check-should-be-multiplied = should be multiplied by { $quantity }
check-should-be-divided = should be divided by { $quantity }
check-should-be-added = should have `{ $added }` added
check-here-it-is = Here it is { $quantity }.
check-this-should = This { $should }: here the values begin to be wrong.
check-this-is = This is { $quantity }.
check-this-should-be-after-a-wrong-value = This should be { $quantity }; an earlier value is wrong.
check-an-earlier-value-is-wrong = An earlier value is wrong.
check-wrong-value = `{ $text }` { $should }

## Properties that need no reference

check-property-finite = every pixel is finite
    .violated = some pixels are NaN or infinite: look for a division by 0, or a square root or power of a negative number
check-property-unchanged-when-turned = the picture does not change when model, light and camera are rotated together
    .violated = the picture changes when model, light and camera are rotated together: some vectors are in different spaces
check-property-linear-in-light = half the light gives half the picture
    .violated = half the light does not give half the picture: the colour must be linear in the light
check-property-additive-over-lights = the picture with two lights is the sum of the pictures with each light alone
    .violated = the picture with two lights is not the sum of the pictures with each light alone
check-property-falls-with-distance = light falls off with distance as the attenuation constants require
    .violated = light does not fall off as the attenuation constants require: doubling the constants must halve the light

## Explanations of compilers' messages; NAME is the name in the message, `…` the same without one

check-compiler-frag-color-removed = `gl_FragColor` was removed in version 330 core: declare `out vec4 FragColor;` and write to that.
check-compiler-texture-functions-renamed = `texture2D` and `textureCube` are called `texture` since version 330 core.
check-compiler-attribute-and-varying-removed = `attribute` and `varying` were removed in version 330 core: write `in` and `out`.
check-compiler-version-not-supported = This computer's OpenGL does not support that `#version`: write `#version 330 core`, which every driver supports.
check-compiler-version-not-first = `#version` must be the first line of the shader; only comments and empty lines may precede it.
check-compiler-no-main = There is no `void main()`: every shader needs one, spelled exactly like this.
check-compiler-position-not-written = The vertex shader never writes to `gl_Position`, the position of the vertex.
check-compiler-not-an-array = Square brackets follow something that is not an array, vector or matrix.
check-compiler-array-without-size = An array needs a constant size where it is declared: `vec3 lights[4];`.
check-compiler-index-out-of-range = The index is out of range: the first element has index 0, and the last one has the size minus 1.
check-compiler-no-such-member = What follows the dot is not a component or member: a vec3 has x, y, z (or r, g, b) but no w; a struct has only the members that it declares.
check-compiler-too-many-values = Too many values in the parentheses: vec3 takes three numbers, or vectors with three components in total.
check-compiler-too-few-values = Too few values in the parentheses: vec4 takes four numbers, for example `vec4(v, 1.0)` for a vec3 v.
check-compiler-initialiser-of-another-type = The value on the right has a different type from the variable on the left: convert it, for example with `vec3(v4)` or `v4.xyz` for a vec4, `vec4(v3, 1.0)` for a vec3.
check-compiler-read-only = `{ $name }` cannot be changed: `in`, `uniform` and `const` variables are read-only. Copy it to a variable of your own and change that.
    .unnamed = It cannot be changed: `in`, `uniform` and `const` variables are read-only. Copy it to a variable of your own and change that.
check-compiler-no-function-for-these-types = No function `{ $name }` takes arguments of these types: check the type of each. `dot`, `reflect`, `cross` and `max` take two arguments of the same type (vec3 and vec3), `texture` takes a sampler and a vec2 (a vec3 for a cubemap).
    .unnamed = No function takes arguments of these types: check the type of each. `dot`, `reflect`, `cross` and `max` take two arguments of the same type (vec3 and vec3), `texture` takes a sampler and a vec2 (a vec3 for a cubemap).
check-compiler-not-written-by-vertex-shader = The fragment shader reads `{ $name }`, but the vertex shader has no `out` of that name: both must have the same name and type.
    .unnamed = The fragment shader reads, but the vertex shader has no `out` of that name: both must have the same name and type.
check-compiler-varying-of-two-types = `{ $name }` is declared in both stages with different types: the vertex shader's `out` and the fragment shader's `in` must match.
    .unnamed = It is declared in both stages with different types: the vertex shader's `out` and the fragment shader's `in` must match.
check-compiler-flat-in-one-stage = `flat` must be written in both stages or in neither; an integer varying requires it.
check-compiler-uniform-of-two-types = The uniform `{ $name }` is declared in both stages with different types: the types must match.
    .unnamed = The uniform is declared in both stages with different types: the types must match.
check-compiler-declared-twice = `{ $name }` is declared twice in the same place: remove one, or rename it.
    .unnamed = It is declared twice in the same place: remove one, or rename it.
check-compiler-reserved-name = `{ $name }` is reserved in GLSL (as are `input`, `output`, `sample`, `filter`, `texture`, names with `gl_` or two underscores): give it another name.
    .unnamed = It is reserved in GLSL (as are `input`, `output`, `sample`, `filter`, `texture`, names with `gl_` or two underscores): give it another name.
check-compiler-division-by-zero = A constant is divided by zero here.
check-compiler-operands-do-not-match = The two sides of the operator do not match: vectors must have the same size (vec3 with vec3), a mat4 multiplies a vec4 (write `vec4(v, 1.0)`), and floats are written with a decimal point (`2.0` instead of `2`).
check-compiler-integer-instead-of-float = Expected a float, found an integer: write it with a decimal point, `2.0` instead of `2`.
check-compiler-different-types = The value and the variable have different types: take some components of the value (`v4.xyz`, `vec3(v4)`) or add the missing ones (`vec4(v3, 1.0)`).
check-compiler-returned-type = The returned value does not have the function's return type.
check-compiler-condition-not-bool = A condition must be a bool: write a comparison, for example `if (x > 0.0)`.
check-compiler-sampler-not-uniform = A sampler can only be a `uniform` or a function's parameter, not a variable or a varying.
check-compiler-no-precision = GLSL ES requires a precision: write `precision mediump float;` under the `#version`.
check-compiler-qualifier-not-allowed = This declaration has a qualifier that is not allowed here: `in`, `out` and `uniform` belong outside of functions, each once, and `layout(location = 0)` on an `in` of a fragment shader needs version 410.
check-compiler-read-before-assigned = `{ $name }` is read before it is assigned a value.
    .unnamed = It is read before it is assigned a value.
check-compiler-recursion = A function calls itself, which GLSL does not allow.
check-compiler-include = GLSL has no `#include`: paste the text of that file here.
check-compiler-extension-missing = The graphics driver does not have that extension: remove the `#extension` line.
check-compiler-character-not-allowed = There is a character that GLSL does not allow, perhaps a quotation mark, a dash or a space copied from a web page or a text document: retype it.
check-compiler-file-ends-too-early = The file ends too early: a `{"}"}`, a `*/` or an `#endif` is missing.
check-compiler-not-linked = The program cannot be linked because one of its shaders did not compile: fix that first.
check-compiler-undeclared = `{ $name }` is not declared here: declare it (`uniform`, `in`, or a variable before this line), or check its spelling, including capitals.
    .unnamed = It is not declared here: declare it (`uniform`, `in`, or a variable before this line), or check its spelling, including capitals.
check-compiler-syntax = The compiler cannot parse this. Often a semicolon or a bracket is missing at the end of the previous line.

## Terms of later exercises

check-ambient-added = Ambient light is added, which the exercise does not ask for
check-highlight-added = A highlight is added, which the exercise does not ask for

## What the faces of a cubemap show

check-panorama-shows-posx = to the right: s runs towards -Z, t towards -Y
check-panorama-shows-negx = to the left: s runs towards +Z, t towards -Y
check-panorama-shows-posy = above: s runs towards +X, t towards +Z
check-panorama-shows-negy = below: s runs towards +X, t towards -Z
check-panorama-shows-posz = behind: s runs towards +X, t towards -Y
check-panorama-shows-negz = straight ahead: s runs towards -X, t towards -Y

## submission/error

check-submission-list-and-more = { $names } and { $more } more
check-submission-ignored = {"ignored: "}
check-submission-no-files = there are no files: hand in a vertex and a fragment shader
check-submission-empty-file = { $file } is empty: save the shader in your editor and hand it in again
check-submission-binary-file = { $file } is not a text file ({ $because }): hand in the shader's source as plain text
check-submission-rich-text = { $file } is a word processor's document, not plain text: save it as plain text (.txt) and hand that in
check-submission-too-large = { $file } has { $bytes } bytes, more than the limit of { $most }: hand in only the shader's source
check-submission-no-shader = there is no shader in { $files }: hand in a vertex and a fragment shader, or the program that holds both as strings
check-submission-missing-stage = the { $missing } shader is missing; found only { $found } ({ $stage }): hand in both stages
check-submission-same-stage-twice = { $found } are all { $stage } shaders, and there is no { $missing } shader: hand in one of each
check-submission-missing-include = { $file }:{ $line }: `{ $included }` is included and is not among the files: hand it in too, or paste its text here
check-submission-no-such-pair = no pair of shaders is called `{ $requested }`: choose one of { $candidates }
check-own-shader-does-not-compile = gonio's own shader does not compile on this driver: { $error }

## Test scenes: what each shows that others do not

check-scene-lab = the lab's own scene: a sphere at half its size
check-scene-stretched = a model that is stretched, rotated and moved
check-scene-coarse = a coarse sphere close to the light
check-scene-behind = the light behind the object
check-scene-distances = the same light at three distances, with strong ambient light
check-scene-turned = another camera, rotated and tilted
check-scene-coloured = another material with a strong colour
check-scene-two-lights = two lights with different positions and strengths
check-scene-second-light = the second of two lights alone
check-scene-one-term = one term alone
check-scene-coarse-mirror = a coarse sphere at half its size, away from the origin
check-scene-front = a sphere in the middle
check-scene-sky-ahead = from the origin, straight ahead
check-scene-sky-right = from the origin, to the right
check-scene-sky-moved = the camera has moved
check-scene-sky-up = upwards, with a tilted head
check-scene-camera-turned = a camera that is rotated to the side and looks down
check-scene-camera-above = from above: up and Front are far from perpendicular
check-scene-camera-tilted = a tilted head: up is not Y
check-scene-camera-off-centre = everything far from the origin, with the camera looking past it
check-scene-camera-lab = the lab's own scene: M is the identity, and the camera is not rotated
check-scene-camera-to-the-right = the same, with the camera moved to the right
check-scene-camera-behind = from behind and below, looking up
check-scene-camera-close = close to the pyramid
check-scene-face = one face of a cubemap
