# check

## check/by_values

check-no-attribute-looks-like-the-position = no attribute looks like the position: name it `position`, or assign its role in names.toml
check-the-output-is-not-the-vertex = the output is not the vertex colour (`color`), so only positions were compared, which is what this exercise is about; the pictures show distances
check-the-lookup-is-right-in-every = the lookup is right in every scene; its colour is changed afterwards
check-lookup-mixed = The colour of the cubemap is mixed with other colours; the pictures show the lookup alone
check-only-the-lookup-was-judged = the colour of the cubemap is mixed with other colours; only the lookup was judged, and the pictures show it
check-the-sky-has-a-depth-of-its-own = the sky is nearer than the largest depth (z = w), so objects beyond its cube are hidden unless the sky is drawn first, without writing depth
check-the-diffuse-light-is-drawn-in = The diffuse light is drawn in steps (toon shading)
check-the-light-is-limited-at-the-vertices = The vertex shader limits the light to 1, before it is interpolated
check-all-but-one-of-the-object = all but one of the object's colours are white
check-right-in-every-test-scene-provided = right in every test scene, provided that { $assumptions }
check-right-in-every-scene = right in every scene
check-right-in-every-scene-by-another = right in every scene, by another method
check-the-picture-differs-from-the-reference = the picture differs from the reference, but the meaning of { $names } is unknown: state it in names.toml
check-no-known-mistake-explains-the-difference = no known mistake explains the difference from the reference in: { $scenes }
check-the-program-sends-without-its-translation = the program sends `{ $name }` without its translation
check-assumed-role = `{ $name }` is `{ $role }`
check-with-this-value-every-test-scene = With this value every test scene is right.

## check/corrections

check-nothing-is-drawn-check-the-value = nothing is drawn: check the value of gl_Position
check-the-picture-is-black-in-every = the picture is black in every scene: look for a vector, colour or strength that is 0 and should not be
check-every-pixel-is-nan-in-every = every pixel is NaN in every scene: look for 0 divided by 0, or for a vector of length 0 that is normalised
check-the-picture-has-a-single-colour = the picture has a single colour in every scene: no term depends on the position or the normal

## check/mod

check-cannot-be-checked-yet = { $id } cannot be checked yet
check-the-picture-is-right-here-only = { $name }; the picture is right here only by chance
check-unchanged-start-files-with-mistake = these are the unchanged start files; { $name }
check-unchanged-start-files = these are the unchanged start files
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

check-also = ; also:{" "}
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
check-panorama-no-known-mistake-explains-the = no known mistake explains { NUMBER($count) ->
        [one] the face { $faces }
       *[other] the faces { $faces }
    }
check-panorama-they-have-of-the-panorama-s = { $name }: they have { $sharpness } % of the panorama's sharpness

## submission/choose

check-submission-line = { $file } line { $line }
check-submission-there-are-several-shaders-and-were = there are several shaders: { $all }; { $vertex } and { $fragment } were checked. If that is the wrong pair, hand in only the right one, or name it.

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
check-submission-invalid-utf-8-at-offset = invalid UTF-8 at offset { $offset }
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
check-inputs-position = position
check-inputs-direction = direction
check-inputs-colour = colour
check-inputs-strength = strength
check-inputs-attenuation = attenuation
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
check-inputs-uniform-takes-numbers = `{ $name }` is a { $glsl_type } and takes { $numbers }, not { $given }
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
check-inputs-the-shaders-have-no-uniform-they = the shaders have no uniform `{ $name }`; they have { $names }
check-inputs-the-shaders-have-no-sampler-did = the shaders have no sampler `{ $name }`; did you mean `{ $near }`?
check-inputs-the-shaders-have-no-sampler-nor = the shaders have no sampler `{ $name }`, nor any other
check-inputs-the-shaders-have-no-sampler-they = the shaders have no sampler `{ $name }`; they have { $names }
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
check-inputs-all-numbers = { $all } numbers
check-inputs-names-takes-numbers = `{ $name }` is a { $ty } and takes { $numbers }, not { $count }
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
check-quantity-reflected-or-refracted-direction = the direction of the reflected or refracted light
check-quantity-looked-up-direction = the direction to look up in the cubemap
check-quantity-unit-half-vector = the unit half vector
check-quantity-sum-of-directions = the sum of the directions to the light and to the eye
check-quantity-cosine-of-light = the cosine between normal and light
check-quantity-twice-the-cosine-of-light = twice the cosine between normal and light
check-quantity-normal-times-the-cosine = the normal times the cosine between normal and light
check-quantity-normal-times-twice-the-cosine = the normal times twice the cosine between normal and light
check-quantity-cosine-of-eye = the cosine between normal and eye
check-quantity-cosine-of-incidence = the cosine between normal and incident direction
check-quantity-twice-the-cosine-of-incidence = twice the cosine between normal and incident direction
check-quantity-normal-times-the-cosine-of-incidence = the normal times the cosine between normal and incident direction
check-quantity-normal-times-twice-the-cosine-of-incidence = the normal times twice the cosine between normal and incident direction
check-quantity-squared-ratio = the square of the ratio of the indices
check-quantity-squared-sine-of-incidence = the squared sine of the angle of incidence
check-quantity-squared-cosine-of-refraction = the squared cosine of the angle of refraction, 1 - ratio^2 (1 - cos^2)
check-quantity-cosine-of-refraction = the cosine of the angle of refraction
check-quantity-position-on-screen-of-the-sky = the position on the screen: P times the position turned by V
check-quantity-turned-position = the position turned by V
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

## Mistakes in GL programs: half a sentence, the rule of OpenGL, the symptom, the fix

check-gl-texture-name-as-unit = the sampler is set to the texture's name instead of its unit
    .explanation = A sampler takes the number of a texture unit. The name of a texture is another number, chosen by OpenGL.
    .looks-like = black, without any error
    .fix = give the sampler the unit that the texture is bound to
check-gl-unbound-unit = the sampler reads a different unit from the one that the texture is bound to
    .explanation = A sampler reads black from a unit without a texture, and OpenGL reports no error.
    .looks-like = black, without any error
    .fix = bind the texture to the unit that the sampler reads, or set the sampler to that unit
check-gl-active-texture-after-bind = the unit is made active after the texture was bound
    .explanation = bind_texture binds to the unit that is active at that moment.
    .looks-like = black, without any error
    .fix = write active_texture before bind_texture
check-gl-active-texture-number = active_texture gets a plain number
    .explanation = Units are called TEXTURE0, TEXTURE1 and so on; OpenGL rejects 0 and 1 here.
    .looks-like = black, or the wrong texture
    .fix = write TEXTURE0 and so on
check-gl-sampler-never-set = the sampler is never set, and reads unit 0
    .explanation = A sampler that is not set reads unit 0, but the texture is bound to another unit.
    .looks-like = black, without any error
    .fix = set the sampler to the texture's unit, with uniform_1i after use_program
check-gl-uniform-before-use-program = the uniform is set before its program is in use
    .explanation = uniform_1i sets a uniform of the program in use. Without one, OpenGL rejects the call, and the uniform stays 0.
    .looks-like = black; OpenGL reports INVALID_OPERATION
    .fix = call use_program first
check-gl-uniform-after-draw = the uniform is set after the draw
    .explanation = A draw uses the values that the uniforms have at that moment.
    .looks-like = black in the first frame
    .fix = set it before the draw
check-gl-uniform-name-wrong = the program has no uniform of that name
    .explanation = The location of an unknown name is -1, which OpenGL ignores without an error.
    .looks-like = as if the uniform were never set
    .fix = write the name as in the shader
check-gl-uniform-type-wrong = the uniform is set by the call for another type
    .explanation = A sampler is an integer: OpenGL rejects uniform_1f for it.
    .looks-like = as if the uniform were never set
    .fix = use uniform_1i
check-gl-mipmaps-missing = the filter needs mipmaps, but there are none
    .explanation = A texture without the mipmaps that its filter needs is incomplete, and reads as black.
    .looks-like = black, without any error
    .fix = call generate_mipmap after tex_image_2d, or use a filter without mipmaps
check-gl-filter-never-set = the filter is never set: the default needs mipmaps, but there are none
    .explanation = The default minification filter of a texture is NEAREST_MIPMAP_LINEAR.
    .looks-like = black, without any error
    .fix = set TEXTURE_MIN_FILTER to LINEAR, or call generate_mipmap
check-gl-mipmaps-before-image = the mipmaps are generated before the image is set
    .explanation = generate_mipmap computes the smaller levels from the content of level 0 at that moment.
    .looks-like = black, without any error
    .fix = call generate_mipmap after tex_image_2d
check-gl-mipmaps-misplaced = the mipmaps are generated for another texture
    .explanation = generate_mipmap works on the texture that is bound to the active unit at that moment.
    .looks-like = a black triangle
    .fix = call generate_mipmap right after tex_image_2d
check-gl-filter-refused = OpenGL rejects the filter
    .explanation = TEXTURE_MAG_FILTER can only be NEAREST or LINEAR; filters with mipmaps are for TEXTURE_MIN_FILTER.
    .looks-like = black, if the other filter then needs mipmaps
    .fix = set TEXTURE_MIN_FILTER to this filter
check-gl-wrong-target = the texture is used with the target of another kind of texture
    .explanation = A sampler2D reads the texture bound to TEXTURE_2D, a samplerCube the one bound to TEXTURE_CUBE_MAP.
    .looks-like = a black triangle
    .fix = write TEXTURE_2D in all calls for this texture
check-gl-texture-not-bound = the texture is never bound
    .explanation = A texture exists once it has been bound, and all calls for it work on the bound texture.
    .looks-like = black; OpenGL reports INVALID_OPERATION
    .fix = call bind_texture before the texture's other calls
check-gl-texture-bound-late = the texture is bound after the calls that are meant for it
    .explanation = tex_image_2d and tex_parameter work on the texture that is bound at that moment.
    .looks-like = a black triangle
    .fix = call bind_texture before them
check-gl-texture-unbound = the texture is unbound before the draw
    .explanation = bind_texture with 0 unbinds the unit's texture.
    .looks-like = black, without any error
    .fix = remove that call, or bind the texture again before the draw
check-gl-other-texture-bound = another texture is bound to the unit that the sampler reads
    .explanation = A unit has one texture of each kind: the last one that was bound while the unit was active.
    .looks-like = another image, or black
    .fix = make another unit active before binding the other texture
check-gl-texture-deleted = the texture is deleted before the draw
    .explanation = Deleting a texture unbinds it from all units.
    .looks-like = black, without any error
    .fix = delete it after the last draw that reads it
check-gl-internal-format-wrong = the texture's internal format loses or changes its colours
    .explanation = R8 keeps only the red channel; SRGB8 is decoded when it is read, so everything is darker.
    .looks-like = red, or too dark
    .fix = write RGB8
check-gl-image-level-wrong = the image is passed to a level other than 0
    .explanation = Level 0 is the full image, and the others are its mipmaps.
    .looks-like = a black triangle
    .fix = pass the image to level 0
check-gl-image-missing = the texture never gets an image
    .explanation = A texture without an image reads as black.
    .looks-like = a black triangle
    .fix = call tex_image_2d
check-gl-image-wrong = the wrong image is loaded
    .explanation = The exercise asks for a different file.
    .looks-like = another pattern
    .fix = load the exercise's image
check-gl-level-range-wrong = the range of levels does not match the levels that exist
    .explanation = TEXTURE_BASE_LEVEL and TEXTURE_MAX_LEVEL define which levels belong to the texture.
    .looks-like = black, or blurred
    .fix = remove these two calls
check-gl-stride-wrong = the stride is wrong
    .explanation = The stride is the number of bytes from one vertex to the next: the size of a whole vertex in the buffer.
    .looks-like = no triangle, or a torn one
    .fix = write the size of a whole vertex, in bytes
check-gl-offset-wrong = the offset of an attribute is wrong
    .explanation = The offset is the number of bytes before the attribute in the first vertex.
    .looks-like = the attribute has the values of another one
    .fix = count the bytes of all attributes before it
check-gl-attribute-size-wrong = the attribute has the wrong number of components
    .explanation = The size is the number of components per vertex, 1 to 4; missing ones are 0, 0, 1.
    .looks-like = flat, torn, or in other colours
    .fix = write the number of components in the data
check-gl-attribute-type-wrong = the attribute has the wrong type
    .explanation = The type defines how OpenGL reads the bytes of the buffer.
    .looks-like = nothing, or noise
    .fix = write FLOAT
check-gl-attribute-not-enabled = the attribute is not enabled
    .explanation = An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).
    .looks-like = one colour everywhere, one texel everywhere, or no triangle
    .fix = call enable_vertex_attrib_array for it
check-gl-attribute-disabled = the attribute is disabled before the draw
    .explanation = An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).
    .looks-like = one colour everywhere, one texel everywhere, or no triangle
    .fix = remove disable_vertex_attrib_array
check-gl-attribute-not-described = the attribute is never described
    .explanation = Without vertex_attrib_pointer, OpenGL does not know where the attribute's data is.
    .looks-like = no triangle
    .fix = call vertex_attrib_pointer for it
check-gl-attribute-name-wrong = the program has no attribute of that name
    .explanation = The location of an unknown name is -1, which OpenGL rejects.
    .looks-like = as if the attribute were not enabled
    .fix = write the name as in the vertex shader
check-gl-vertex-array-missing = there is no vertex array
    .explanation = In OpenGL's core profile, attributes are stored only in vertex arrays.
    .looks-like = no triangle; OpenGL reports INVALID_OPERATION
    .fix = create one with gen_vertex_array and bind it
check-gl-vertex-array-not-bound = the vertex array is never bound
    .explanation = Attributes are stored in the bound vertex array.
    .looks-like = no triangle; OpenGL reports INVALID_OPERATION
    .fix = call bind_vertex_array before the attributes are described
check-gl-vertex-array-bound-late = the vertex array is bound after the attributes were described
    .explanation = Attributes are stored in the vertex array that is bound at that moment.
    .looks-like = no triangle
    .fix = call bind_vertex_array first
check-gl-vertex-array-unbound = no vertex array is bound at the draw
    .explanation = A draw reads the attributes of the vertex array that is bound.
    .looks-like = no triangle; OpenGL reports INVALID_OPERATION
    .fix = bind the vertex array again before the draw
check-gl-other-vertex-array = another vertex array is bound at the draw
    .explanation = A draw reads the attributes of the vertex array that is bound.
    .looks-like = no triangle, or another one
    .fix = bind the vertex array in which the attributes were described
check-gl-vertex-array-deleted = the vertex array is deleted before the draw
    .explanation = Deleting a vertex array deletes its description of the attributes.
    .looks-like = no triangle
    .fix = delete it after the last draw
check-gl-buffer-not-bound = the buffer is never bound
    .explanation = buffer_data fills the bound buffer, and vertex_attrib_pointer refers to it.
    .looks-like = no triangle
    .fix = call bind_buffer ARRAY_BUFFER first
check-gl-buffer-bound-late = the buffer is bound after the calls that are meant for it
    .explanation = buffer_data fills the buffer that is bound at that moment, and vertex_attrib_pointer refers to it.
    .looks-like = no triangle
    .fix = call bind_buffer before them
check-gl-buffer-unbound = the buffer is unbound before the attributes are described
    .explanation = vertex_attrib_pointer refers to the buffer that is bound to ARRAY_BUFFER at that moment.
    .looks-like = no triangle
    .fix = unbind it after vertex_attrib_pointer, or not at all
check-gl-buffer-target-wrong = the buffer is bound to the wrong target
    .explanation = Vertices are read from ARRAY_BUFFER, indices from ELEMENT_ARRAY_BUFFER.
    .looks-like = no triangle
    .fix = bind vertices to ARRAY_BUFFER
check-gl-buffer-empty = the buffer is never filled
    .explanation = A buffer is empty until buffer_data fills it.
    .looks-like = no triangle
    .fix = call buffer_data
check-gl-buffer-deleted = the buffer is deleted before the draw
    .explanation = Deleting a buffer detaches it from the bound vertex array.
    .looks-like = no triangle
    .fix = delete it after the last draw
check-gl-other-data = the buffer is filled with another list
    .explanation = The draw reads the data that the buffer was filled with last.
    .looks-like = another shape
    .fix = pass the corners to buffer_data
check-gl-data-changed = the corners are not the exercise's
    .explanation = The mistake is in a call; the numbers of the corners were right.
    .looks-like = another triangle, or other colours
    .fix = restore the original numbers
check-gl-index-type-wrong = the indices have the wrong type
    .explanation = The type in draw_elements is the type of the indices in the buffer: here UNSIGNED_INT, four bytes each.
    .looks-like = no triangle, or a torn one
    .fix = write UNSIGNED_INT
check-gl-index-offset-wrong = the draw begins at the wrong index
    .explanation = The last argument of draw_elements is an offset in bytes.
    .looks-like = another triangle, or none
    .fix = write 0
check-gl-indices-from-one = the indices count from 1
    .explanation = The first vertex of a buffer has index 0; in .obj files it has index 1.
    .looks-like = a corner is missing or wrong
    .fix = subtract 1 from each index
check-gl-indices-changed = the indices refer to other corners
    .explanation = Each index is the number of a corner, from 0.
    .looks-like = another triangle
    .fix = write 0 1 2
check-gl-index-buffer-not-bound = no index buffer is bound in the vertex array
    .explanation = A vertex array stores the ELEMENT_ARRAY_BUFFER that is bound while the vertex array is bound.
    .looks-like = no triangle
    .fix = bind the index buffer after the vertex array
check-gl-program-not-used = the program is never used
    .explanation = A draw runs the program in use; linking a program does not select it.
    .looks-like = no triangle
    .fix = call use_program
check-gl-program-switched-off = no program is in use at the draw
    .explanation = use_program with 0 deselects the program.
    .looks-like = no triangle
    .fix = call use_program with the program before the draw
check-gl-program-number-wrong = use_program gets a number that is not a program
    .explanation = create_program returns the number of a program.
    .looks-like = no triangle
    .fix = pass the number that create_program returned
check-gl-draw-missing = nothing is drawn
    .explanation = Without a draw call, there is only the background.
    .looks-like = no triangle
    .fix = call draw_arrays
check-gl-draw-count-wrong = the number of vertices is wrong
    .explanation = The count is the number of vertices, not of triangles or floats.
    .looks-like = no triangle, or a part of it
    .fix = write 3
check-gl-draw-first-wrong = the draw begins at the wrong vertex
    .explanation = The first vertex is 0.
    .looks-like = no triangle, or another one
    .fix = write 0
check-gl-draw-mode-wrong = the vertices are connected in another way
    .explanation = TRIANGLES draws one triangle for every three vertices.
    .looks-like = points or lines
    .fix = write TRIANGLES
check-gl-draw-too-early = the draw comes before everything is set up
    .explanation = A draw uses the state at that moment; later calls affect the next draw.
    .looks-like = no triangle, or a black one
    .fix = draw after everything else
check-gl-viewport-wrong = the viewport is not the whole picture
    .explanation = viewport defines where clip space is mapped to on the picture.
    .looks-like = no triangle, or a small one in a corner
    .fix = set it to 0, 0 and the picture's size, or remove it
check-gl-clear-missing = the picture is never cleared
    .explanation = Pixels that are not drawn keep their previous content.
    .looks-like = another background
    .fix = call clear COLOR_BUFFER_BIT before the draw
check-gl-clear-after-draw = the picture is cleared after the draw
    .explanation = clear erases what was drawn.
    .looks-like = only the background
    .fix = clear first, then draw
check-gl-clear-color-late = the background colour is set after clear
    .explanation = clear uses the colour that is set at that moment.
    .looks-like = another background
    .fix = set clear_color before clear
check-gl-clear-color-wrong = the background has the wrong colour
    .explanation = clear fills the picture with the colour of clear_color.
    .looks-like = another background
    .fix = write clear_color 0.2 0.25 0.3 1.0
check-gl-culled = the triangle's face is culled
    .explanation = With CULL_FACE, faces with clockwise corners are not drawn.
    .looks-like = no triangle
    .fix = disable CULL_FACE, or reverse the order of the corners

## Mistakes in readers of OBJ files: a title, what the program does, the change that fixes it

check-buffer-indices-from-0 = Indices are treated as counting from 0
    .explanation = An OBJ file counts its vertices, texture coordinates and normals from 1. Used as indices into an array that starts at 0, each one is off by one, and the last one is out of range.
    .fix = Subtract 1 from each index before you use it.
check-buffer-tex-coord-and-normal-swapped = vt and vn are swapped in f
    .explanation = The corners of a face are v/vt/vn, in this order. Here the second number is used as the index of the normal and the third as that of the texture coordinate.
    .fix = Use the second number of a corner for vt, the third for vn.
check-buffer-v-flipped = v is 1 - v
    .explanation = v runs from the bottom to the top in an OBJ file, and here from the top down. That is right if images are loaded with their first row first and not flipped; otherwise textures are upside down.
    .fix = Pass v to OpenGL unchanged and flip the image when loading it, stbi_set_flip_vertically_on_load(true); or keep 1 - v, but do only one of the two.
check-buffer-quads-first-triangle-only = Only the first triangle of each polygon
    .explanation = A face with four corners is two triangles. Here only its first three corners are read, so half of each quad is missing.
    .fix = Make a triangle of the corners 1, i and i + 1 for each i from 2 to the second last.
check-buffer-quads-lost = Faces with more than three corners are left out
    .explanation = Only triangular faces are in the buffer; quads and larger polygons are missing.
    .fix = Split polygons into triangles: corners 1, i, i + 1.
check-buffer-quads-as-triangles = Corner 4 of a quad starts the next triangle
    .explanation = All corners of all faces form one list, and every three are drawn as a triangle. After the first quad the triangles join corners of different faces.
    .fix = Handle each f line by itself: split it into triangles before reading the next one.
check-buffer-large-polygons-cut-short = Only the first four corners of larger polygons
    .explanation = Triangles and quads are right, but only the first four corners of larger faces are read.
    .fix = Read corners until the line ends, and split any number of them into triangles.
check-buffer-large-polygons-lost = Faces with more than four corners are left out
    .explanation = Triangles and quads are in the buffer; faces with five or more corners are missing.
    .fix = Read corners until the line ends, and split any number of them into triangles.
check-buffer-concave-polygon-as-fan = A concave polygon is split as a fan
    .explanation = Triangles of the corners 1, i, i + 1 cover a polygon only if it has no corner that points inwards. Here some are outside it, turned over.
    .fix = Cut off ears: corners that point outwards and whose triangle contains no other corner. Or triangulate in Blender's export.
check-buffer-normals-by-position = Normals are looked up by the position's index
    .explanation = The corner v/vt/vn defines its normal. Here the first number is used for the normal as well, so a position always has the normal with the same index.
    .fix = Use the third number of a corner as the index of its vn.
check-buffer-tex-coords-by-position = Texture coordinates are looked up by the position's index
    .explanation = The corner v/vt/vn defines its texture coordinate. Here the first number is used for it as well.
    .fix = Use the second number of a corner as the index of its vt.
check-buffer-vertices-not-split = One texture coordinate and one normal for each position
    .explanation = A position that belongs to several faces may have a different normal and texture coordinate in each. Here they are stored per position, and one corner's values replace those of all others.
    .fix = Make a vertex for each distinct v/vt/vn, not for each v (or simply one for each corner).
check-buffer-normals-missing = The normals are not the file's: all are the same
    .explanation = The file has normals, but every vertex of the buffer has the same one, or zero.
    .fix = Read the vn lines, and give each corner the one that its third number refers to.
check-buffer-tex-coords-missing = The texture coordinates are not the file's: all are zero
    .explanation = The file has texture coordinates, but every vertex of the buffer has (0, 0).
    .fix = Read the vt lines, and give each corner the one that its second number refers to.
check-buffer-negative-as-positive = The sign of negative indices is lost
    .explanation = -1 means the last vertex before the line, -2 the one before that. Here the minus sign is dropped, and the index counts from the start.
    .fix = If an index is negative, add it to the number of vertices (or vt, or vn) read so far.
check-buffer-negative-faces-lost = Faces with negative indices are left out
    .explanation = -1 means the last vertex before the line. The faces that use negative indices are missing here.
    .fix = If an index is negative, add it to the number of vertices (or vt, or vn) read so far.
check-buffer-negative-from-the-end-of-the-file = Negative indices count from the end of the file
    .explanation = -1 means the last vertex before the f line, not the last one of the whole file. Here the faces are resolved after everything was read, with the final lengths of the lists.
    .fix = Turn a negative index into a positive one while reading its line: add the number of vertices so far, plus 1.
check-buffer-negative-one-too-far = 1 is subtracted from negative indices too
    .explanation = Subtract 1 from positive indices, which count from 1, but not from negative ones, which count back from the end. Here -1 refers to the second last vertex.
    .fix = Subtract 1 from positive indices only.
check-buffer-normal-indices-from-0 = Only the indices of normals are treated as counting from 0
    .explanation = Positions are right, but the index of the normal is used without subtracting 1: each corner has the next normal.
    .fix = Subtract 1 from the third number of a corner too.
check-buffer-tex-coord-indices-from-0 = Only the indices of texture coordinates are treated as counting from 0
    .explanation = Positions are right, but the index of the texture coordinate is used without subtracting 1: each corner has the next one.
    .fix = Subtract 1 from the second number of a corner too.
check-buffer-position-indices-from-0 = Only the indices of positions are treated as counting from 0
    .explanation = Texture coordinates and normals are right, but the index of the position is used without subtracting 1.
    .fix = Subtract 1 from the first number of a corner too.
check-buffer-u-and-v-swapped = u and v are swapped
    .explanation = A vt line contains u, then v. Here they are swapped in the buffer, and textures lie on their side.
    .fix = Write the first number of vt first.
check-buffer-y-and-z-swapped = y and z are swapped
    .explanation = The buffer contains x, z, y: the model lies on its back and is mirrored, so that its inside is visible.
    .fix = Write the numbers of v and vn in the order of the file. To turn a model, use the model matrix.
check-buffer-turned-to-z-up = The model is turned: x, z, -y
    .explanation = The model is turned by 90 degrees around x, as programs do in which z points up.
    .fix = Write the numbers of v and vn in the order of the file. To turn a model, use the model matrix.
check-buffer-winding-reversed = Triangles have the opposite winding
    .explanation = The corners of a face are counter-clockwise when seen from the front. Here two corners of each triangle are swapped: with face culling, its front is not drawn.
    .fix = Keep the order of the corners: 1, i, i + 1.
check-buffer-faces-ignored = The faces are ignored: v, vt and vn are in the file's order
    .explanation = The lists v, vt and vn are combined by position. The f lines define which of them belong together, and which three form a triangle.
    .fix = For each corner of each f line, append the position, texture coordinate and normal that it refers to.
check-buffer-indices-not-applied = Each distinct vertex is in the buffer once, without its indices
    .explanation = These are the vertices for glDrawElements, without the indices that combine them into triangles.
    .fix = Write one row for each corner of each triangle, or hand in JSON with "vertices" and "indices".
check-buffer-one-normal-per-face = All corners of a face have the normal of its first corner
    .explanation = Each corner refers to its own normal. Here that of the first corner is used for the whole face, and round models look faceted.
    .fix = Use the third number of each corner.
check-buffer-normals-computed = Normals are computed from the triangles
    .explanation = The normals are those of the flat triangles, not those of the file: round models look faceted.
    .fix = Read the vn lines. Compute normals only for files that have none.
check-buffer-last-object-only = Only the last object is read
    .explanation = A file may contain several objects (o lines). Only the faces of the last one are in the buffer: each o line discards what was read before.
    .fix = Do not clear your lists at an o line.
check-buffer-first-object-only = Only the first object is read
    .explanation = A file may contain several objects (o lines). Only the faces of the first one are in the buffer.
    .fix = Continue reading after the second o line.
check-buffer-indices-anew-in-each-object = Indices restart in each object
    .explanation = Indices count through the whole file, whatever its objects. Here they are counted from the first vertex of each object.
    .fix = Do not restart the count at an o line.
check-buffer-first-lines-skipped = The first line of each kind is skipped
    .explanation = The first v, vt, vn and f are missing: everything is off by one, and one face is lost.
    .fix = Check how your loop starts: it may read a line too early, or skip the first element.
check-buffer-last-face-lost = The last face is missing
    .explanation = All faces except the last are in the buffer: the loop ends one step too early, or needs a line end after the last line.
    .fix = Handle each line before testing whether there is another: while (std::getline(file, line)).
check-buffer-numbers-truncated = Numbers lose their fraction
    .explanation = 0.625 becomes 0. The numbers are read as integers (int, atoi), or by a function that expects a decimal comma and stops at the point.
    .fix = Read floats, with the C locale: setlocale(LC_NUMERIC, "C"), std::locale::classic().
check-buffer-decimal-comma = Reading stops at the first decimal point of a line
    .explanation = Only the integer part of the first number of each line is read, and the rest is 0: the stream expects a decimal comma, as in French, Dutch and German locales, or is read into integers.
    .fix = Call file.imbue(std::locale::classic()) before reading, and read floats.
check-buffer-empty-slot-passed-over = v//vn is read as v/vt
    .explanation = The second slot of a corner v//vn is empty. Here empty slots disappear when the corner is split, and the index of the normal is used for the texture coordinate.
    .fix = Split at each `/`, and keep empty parts.
check-buffer-short-corners-lost = Faces whose corners are not v/vt/vn are left out
    .explanation = A corner may also be v, v/vt or v//vn. Faces with such corners are missing: "%d/%d/%d" does not match them.
    .fix = Split corners at `/`, and check how many parts there are and which are empty.

## buffers/buffer

check-buffer-the-columns-are-x-y-z = the columns are x y z nx ny nz u v here; expected x y z u v nx ny nz
check-buffer-the-numbers-are-64-bit-floats = the numbers are 64-bit floats; expected 32-bit ones (float, np.float32, Float32Array)
check-buffer-line = line { $line }: { $message }
check-buffer-line-column = line { $line }, column { $column }: { $message }

## buffers/compare

check-buffer-the-buffer-has-rows-which-is = the buffer has { $count } rows, which is not a multiple of three: three rows make a triangle
check-buffer-numbers-are-rounded-to-few-digits = numbers are rounded to few digits: the buffer is right, but write at least six digits (std::setprecision, %.6f)
check-buffer-most-of-the-buffer-s-numbers = most of the buffer's numbers are not in the model's file: is it the buffer of another model?

## buffers/formats

check-buffer-file-too-large = the file has { $count } MB; at most { $most } MB are read
check-buffer-the-file-is-empty-was-it = the file is empty: was it closed before the program ended?
check-buffer-raw-floats-take-4-bytes-each = raw floats take 4 bytes each, but the file has { $count } bytes: was it opened as text ("w" instead of "wb", without std::ios::binary)?
check-buffer-floats-not-of-stride = the file has { $floats } floats, which is not a multiple of the { $stride } that its name states
check-buffer-floats-not-whole-vertices = the file has { $floats } floats, which is not a multiple of 3, 5, 6 or 8: not whole vertices

## buffers/json

check-buffer-expected-a-list-of-rows-a = expected a list of rows, a list of objects, {"{"}"positions", "tex_coords", "normals"{"}"} or {"{"}"vertices", "indices"{"}"}
check-buffer-json-too-large = the file has { $count } MB; at most { $most } MB of JSON are read: write raw floats instead
check-buffer-json-has-no-nan-write-null = {" "}(JSON has no NaN: write null)
check-buffer-invalid-json = invalid JSON: { $message }{ $hint }
check-buffer-the-list-is-empty-no-vertex = the list is empty: no vertex was written
check-buffer-the-file-has-no-vertices = the file has no vertices
check-buffer-a-vertex-buffer = a vertex buffer
check-buffer-the-list-has-numbers-which-is = the list has { $count } numbers, which is not a multiple of 3, 5, 6 or 8
check-buffer-row-is-not-a-list-of = row { $number } is not a list of numbers; { $shapes }
check-buffer-row-has-numbers-but-the-first = row { $number } has { $count } numbers, but the first one has { $first }
check-buffer-a-row-has-numbers-it-may = a row has { $count } numbers; it may have 3 (x y z), 5 (x y z u v), 6 (x y z nx ny nz) or 8 (x y z u v nx ny nz)
check-buffer-vertex-is-not-an-object-but = vertex { $number } is not an object, but the first one is
check-buffer-vertex = vertex { $number }: { $message }
check-buffer-vertex-does-not-have-the-same = vertex { $number } does not have the same attributes as the first one
check-buffer-has-numbers-instead-of = `{ $key }` has { $found } numbers instead of { $count }
check-buffer-has-no-number = has no number `{ $name }`
check-buffer-is-unknown-and-was-ignored = `{ $key }` is unknown and was ignored
check-buffer-vertices-is-one-list-of-numbers = "vertices" is one list of numbers; with indices it must be a list of rows, [[x, y, z], ...]
check-buffer-texture-coordinates = texture coordinates
check-buffer-normals = normals
check-buffer-there-are-positions-and-each-vertex = there are { $positions } positions and { $count } { $name }: each vertex of the buffer needs one of each, combined as the faces define
check-buffer-has-numbers-which-is-not-a = `{ $key }` has { $count } numbers, which is not a multiple of { $width }
check-buffer-row-of-is-not-a-list = row { $number } of `{ $key }` is not a list of { $width } numbers
check-buffer-is-not-a-list-of-numbers = `{ $key }` is not a list of numbers
check-buffer-indices-is-not-a-list-of = "indices" is not a list of numbers
check-buffer-index-is-expected-an-integer-from = index { $number } is { $value }; expected an integer from 0 to 16777215
check-buffer-indices-count-from-0-here = : indices count from 0 here
check-buffer-index-is-out-of-range-there = index { $index } is out of range: there are { $count } vertices{ $hint }

## buffers/table

check-buffer-the-file-has-no-rows = the file has no rows
check-buffer-the-file-has-a-header-but = the file has a header but no rows
check-buffer-the-numbers-have-decimal-commas-write = the numbers have decimal commas: write decimal points, which every program reads
check-buffer-of-the-numbers-are-nan-or = { $count } of the numbers are NaN or infinite
check-buffer-a-row-has-numbers-without-a = a row has { $width } numbers; without a header line it may have 3 (x y z), 5 (x y z u v), 6 (x y z nx ny nz) or 8 (x y z u v nx ny nz)
check-buffer-the-file-is-utf-16-text = the file is UTF-16 text (PowerShell's `>` writes it): save it as UTF-8
check-buffer-the-file-is-binary-use-the = the file is binary: use the ending `.raw` for raw floats
check-buffer-the-file-is-not-utf-8 = the file is not UTF-8 text
check-buffer-a-number-is-missing-here = a number is missing here
check-buffer-is-not-a-number = `{ $cell }` is not a number
check-buffer-do-the-numbers-have-decimal-commas = {" "}(do the numbers have decimal commas? Write decimal points.)
check-buffer-this-row-has-numbers-but-the = this row has { $count } numbers, but the first one has { $width }{ $comma }
check-buffer-the-column-is-named-twice = the column `{ $name }` is named twice
check-buffer-the-column-is-unknown-and-was = the column `{ $name }` is unknown and was ignored
check-buffer-the-header-has-no-column-the = the header has no column { $name }: the names are x y z, u v, nx ny nz

## gl_program/check

check-gl-cannot-read-the-exercise-s-own = cannot read the exercise's own program: { $first }
check-gl-the-picture-is-right = the picture is right
check-gl-the-picture-is-right-but = the picture is right; but { $text }
check-gl-the-picture-is-right-and-there = the picture is right, and there are { $many } warnings
check-gl-line-of-mistake = line { $line }: { $name }
check-gl-unexplained-with-rejected-call = the picture is wrong, and no known mistake explains it; OpenGL rejected a call: { $error }
check-gl-unexplained = the picture is wrong, and no known mistake explains it

## gl_program/compare

check-gl-cannot-draw-the-exercise-s-own = cannot draw the exercise's own program: { $error }

## gl_program/findings

check-gl-line-of-error = line { $line }: { $message }
check-gl-and-more = { $first }, and { $more } more
check-gl-did-you-mean = did you mean `{ $known }`?
check-gl-the-files-are = the files are { $files }
check-gl-unknown-file = unknown file `{ $file }`
check-gl-and-do-not-link = `{ $vertex }` and `{ $fragment }` do not link: { $log }
check-gl-the-outputs-of-the-vertex-shader = the outputs of the vertex shader and the inputs of the fragment shader must have the same names and types
check-gl-opengl-could-not-create-a-program = OpenGL could not create a program from the shaders
check-gl-the-shader-does-not-compile = the shader does not compile: { $log }
check-gl-although-the-picture-is-right = { $message }, although the picture is right
check-gl-opengl-rejects-with = OpenGL rejects { $call } with { $code }: { $why }
check-gl-depth-test-is-enabled-but-no = DEPTH_TEST is enabled, but no call clears DEPTH_BUFFER_BIT: a second frame would stay empty
check-gl-the-program-has-no-uniform-and = the program has no uniform `{ $uniform }`, and OpenGL reports no error
check-gl-clamp-to-border-mixes-the-border = CLAMP_TO_BORDER mixes the border's colour, black, into the texture's edge

## gl_program/program

check-gl-the-text-has-bytes = the text has { $count } bytes
check-gl-at-most-mb-are-read = at most { $most } MB are read
check-gl-the-file-is-not-text = the file is not text
check-gl-hand-in-the-gl-program-as = hand in the GL program as text
check-gl-call-within-list = the list `{ $name }`, which starts in line { $line }, has no end before this call
check-gl-there-are-more-than-calls = there are more than { $most } calls
check-gl-leave-some-out = leave some out
check-gl-list-without-end = the list `{ $name }`, which starts in line { $line }, has no end
check-gl-write-a-line-with-end-after = write a line with `end` after its last number
check-gl-the-program-has-no-calls = the program has no calls
check-gl-each-line-has-a-call-for = each line has a call, for example `gen_texture`
check-gl-expects-one-name-and-the-numbers = `{ $text }` expects one name, and the numbers on the following lines
check-gl-for-example-corners = for example `{ $text } corners`
check-gl-cannot-be-a-name = `{ $text }` cannot be a name
check-gl-choose-a-name-that-is-not = choose a name that is not a call
check-gl-already-exists = `{ $text }` already exists
check-gl-choose-another-name = choose another name
check-gl-write-integers-from-0 = write integers from 0
check-gl-is-not-an-index = `{ $text }` is not an index
check-gl-write-numbers-such-as-0-5 = write numbers such as 0.5, and `end` after the last one
check-gl-is-not-a-number = `{ $text }` is not a number
check-gl-the-list-has-more-than-numbers = the list `{ $name }` has more than { $most } numbers
check-gl-make-it-shorter-a-buffer-may = make it shorter: a buffer may have at most 1 MB

## gl_program/signature

check-gl-a-list-of-numbers = a list of numbers
check-gl-an-image = an image
check-gl-a-number = a number
check-gl-expected-spaces-around = expected spaces around `=`
check-gl-write-name-call = write `name = call`
check-gl-expected-a-call-after = expected a call after `=`
check-gl-write-name-gen-texture-or-the = write `name = gen_texture` or the like
check-gl-expects-argument-but-got = `{ $text }` expects { NUMBER($count) ->
        [one] { $count } argument
       *[other] { $count } arguments
    }, but got { $given }
check-gl-write = write `{ $text }`
check-gl-write-plain = write { $text }
check-gl-is-a-constant-of-opengl = `{ $text }` is a constant of OpenGL
check-gl-is-already = `{ $text }` is already { $words }
check-gl-take-another-name = take another name
check-gl-write-name = write `name = { $text }`
check-gl-the-result-of-is-not-stored = the result of `{ $text }` is not stored
check-gl-returns-nothing-that-can-be-stored = `{ $text }` returns nothing that can be stored in `{ $text2 }`
check-gl-write-without-a-name = write `{ $text }` without a name
check-gl-unknown-word = unknown call `{ $word }`
check-gl-an-argument-is-missing = an argument is missing
check-gl-write-the-name-that-it-has = write the name that it has in the shader; gonio looks up its location
check-gl-cannot-be-the-name-of-a = `{ $text }` cannot be the name of a shader variable
check-gl-is-too-large = `{ $text }` is too large
check-gl-is-not-an-integer = `{ $text }` is not an integer
check-gl-write-an-integer-such-as-32 = write an integer such as 32
check-gl-write-a-number-such-as-0 = write a number such as 0.5
check-gl-is-neither-true-nor-false = `{ $other }` is neither TRUE nor FALSE
check-gl-write-false = write FALSE
check-gl-named-is-not-a-number = `{ $text }` is { $words }, not a number
check-gl-use-a-name-that-stores-the = use a name that stores the result of a call
check-gl-a-line-must-come-before-this = a line `{ $text } = ...` must come before this one
check-gl-named-is-of-another-kind = `{ $text }` is { $words }, not { $words2 }
check-gl-create-one-with = create one with `{ $how }`
check-gl-create-it-first-with = create it first, with `{ $how }`
check-gl-is-not-defined-yet = `{ $text }` is not defined yet
check-gl-write-without-gl-commas-and-parentheses = write `{ $bare }`, without GL_, commas and parentheses
check-gl-write-constants-in-upper-case-without = write constants in upper case, without GL_
check-gl-unknown-constant = unknown constant `{ $text }`
check-gl-write-with-its-arguments-without-parentheses = write `{ $known }`, with its arguments without parentheses and commas
check-gl-write-calls-without-gl-in-lower = write calls without `gl`, in lower case, with `_` between words
check-gl-text-md-has-a-table-of = text.md has a table of the calls
check-gl-unknown-call = unknown call `{ $text }`

## gl_program/suspects/picture

check-gl-the-index-buffer-contains-unsigned-int = the index buffer contains UNSIGNED_INT, but is read as { $name }
check-gl-write-unsigned-int = write UNSIGNED_INT
check-gl-the-draw-begins-at-byte-of = the draw begins at byte { $offset } of the index buffer
check-gl-write-0 = write 0
check-gl-the-indices-in-start-at-1 = the indices in `{ $name }` start at 1, but the first corner is 0
check-gl-subtract-1-from-each = subtract 1 from each
check-gl-contains-other-corners-than-0-1 = `{ $name }` contains other corners than 0, 1 and 2
check-gl-write-0-1-2 = write 0 1 2
check-gl-no-element-array-buffer-or-another = no ELEMENT_ARRAY_BUFFER, or another one, is bound in the vertex array that is drawn
check-gl-write-bind-buffer-element-array-buffer = write `bind_buffer ELEMENT_ARRAY_BUFFER { $buffer }` after bind_vertex_array
check-gl-is-created-but-never-used = `{ $name }` is created but never used
check-gl-write-use-program-before-the-uniforms = write `use_program { $name }` before the uniforms and the draw
check-gl-0-unbinds-the-program-and-the = 0 unbinds the program, and the draw that follows has none
check-gl-this-is-not-the-number-of = this is not the number of `{ $name }`
check-gl-write-use-program = write `use_program { $name }`
check-gl-the-picture-is-drawn-into-x = the picture is drawn into { $width } x { $height } pixels at ({ $x }, { $y })
check-gl-set-it-to-0-0-and = set it to 0 0 and the picture's width and height, or remove it
check-gl-this-clears-what-line-has-drawn = this clears what line { $line } has drawn
check-gl-write-it-before-the-draw = write it before the draw
check-gl-the-picture-keeps-its-previous-content = the picture keeps its previous content
check-gl-write-clear-color-buffer-bit-before = write `clear COLOR_BUFFER_BIT` before it
check-gl-write-clear-color = write `clear_color { $r } { $g } { $b } { $a }`
check-gl-no-clear-color-comes-before-this = no clear_color comes before this, so the background is black
check-gl-clear-in-line-uses-the-colour = clear, in line { $line }, uses the colour that was set before it
check-gl-write-it-before-clear = write it before clear
check-gl-the-background-is-not-the-exercise = the background is not the exercise's dark grey-blue
check-gl-the-triangle-s-corners-are-clockwise = the triangle's corners are clockwise, and CULL_FACE discards such triangles
check-gl-remove-it = remove it
check-gl-write-draw-arrays-at-the-end = write `draw_arrays { $name } { $first } { $count }` at the end
check-gl-no-call-draws-anything = no call draws anything
check-gl-vertices-are-drawn-but-there-are = { $many } vertices are drawn, but there are { $count }
check-gl-the-draw-begins-at-vertex = the draw begins at vertex { $from }
check-gl-indices-are-drawn-but-there-are = { $many } indices are drawn, but there are { $count }
check-gl-joins-the-corners-in-another-way = { $name } joins the corners in another way than { $name2 }
check-gl-the-calls-that-follow-are-meant = the calls that follow are meant for the draw, but come after it
check-gl-write-it-at-the-end = write it at the end

## gl_program/suspects/textures

check-gl-the-draw-in-line-has-already = the draw in line { $draw } has already read `{ $uniform }`
check-gl-is-set-to-the-name-of = `{ $uniform }` is set to `{ $name }`, the name of a texture, which is bound to unit { $unit }
check-gl-write-uniform-1i = write `uniform_1i { $uniform } { $unit }`
check-gl-is-a-sampler-and-a-sampler = `{ $uniform }` is a sampler, and a sampler is an integer
check-gl-reads-unit-but-the-texture-is = `{ $uniform }` reads unit { $value }, but the texture is bound to unit { $unit }
check-gl-write-uniform-1i-or-bind-the = write `uniform_1i { $uniform } { $unit }`, or bind the texture to unit { $value }
check-gl-the-program-has-no-uniform-its = the program has no uniform `{ $uniform }`; its sampler is `{ $sampler }`
check-gl-no-program-is-in-use-here = no program is in use here: use_program comes in line { $line }, and `{ $uniform }` stays 0
check-gl-write-it-after-use-program-in = write it after use_program in line { $line }
check-gl-is-made-active-only-after-the = { $name } is made active only after the texture was bound, in line { $bind }
check-gl-write-it-before-bind-texture-in = write it before bind_texture in line { $bind }
check-gl-a-plain-number-is-not-a = a plain number is not a unit, and OpenGL rejects it: write a unit such as { $name }
check-gl-is-never-set-and-reads-unit = `{ $sampler }` is never set and reads unit 0, but the texture is bound to unit { $unit }
check-gl-write-uniform-1i-after-use-program = write `uniform_1i { $sampler } { $unit }` after use_program
check-gl-texture-is-deleted = the texture is deleted before the draw in line { $line }
check-gl-buffer-is-deleted = the buffer is deleted before the draw in line { $line }
check-gl-vertex-array-is-deleted = the vertex array is deleted before the draw in line { $line }
check-gl-delete-it-after-the-draw = delete it after the draw
check-gl-is-the-target-of-another-kind = { $written } is the target of another kind of texture: the sampler2D reads TEXTURE_2D
check-gl-write-texture-2d-in-this-line = write TEXTURE_2D in this line and in all others for this texture
check-gl-write-texture-2d = write TEXTURE_2D
check-gl-write-bind-texture-texture-2d-before = write `bind_texture TEXTURE_2D { $name }` before the texture's other calls
check-gl-the-texture-is-never-bound = the texture `{ $name }` is never bound
check-gl-the-call-in-line-is-meant = the call in line { $first } is meant for this texture, but comes before it is bound
check-gl-write-it-before-line = write it before line { $line }
check-gl-0-unbinds-the-texture-so-the = 0 unbinds the texture, so the draw reads an empty unit
check-gl-this-texture-replaces-the-one-to = this texture replaces the one to draw, because the same unit is active
check-gl-call-active-texture-with-another-unit = call active_texture with another unit before it
check-gl-should-be-drawn-but-something-else = `{ $name }` should be drawn, but something else is bound here
check-gl-write-bind-texture = write `bind_texture { $name } { $name2 }`
check-gl-with-this-levels-are-read-that = with this { $name }, levels are read that do not exist
check-gl-opengl-rejects-for-texture-mag-filter = OpenGL rejects { $name } for TEXTURE_MAG_FILTER, and TEXTURE_MIN_FILTER is unchanged
check-gl-write-texture-min-filter = write TEXTURE_MIN_FILTER
check-gl-opengl-rejects-and-texture-min-filter = OpenGL rejects { $name }, and TEXTURE_MIN_FILTER is unchanged
check-gl-write-linear = write LINEAR
check-gl-the-filter-set-in-line-needs = the filter set in line { $line } needs mipmaps, but this image has none
check-gl-write-generate-mipmap-texture-2d-after = write `generate_mipmap TEXTURE_2D` after it, or use the filter LINEAR
check-gl-texture-min-filter-is-never-set = TEXTURE_MIN_FILTER is never set; its default needs mipmaps, and this image has none
check-gl-write-tex-parameter-texture-2d-texture = write `tex_parameter TEXTURE_2D TEXTURE_MIN_FILTER LINEAR`, or `generate_mipmap TEXTURE_2D` after it
check-gl-the-image-comes-only-in-line = the image comes only in line { $image }
check-gl-write-it-after-line = write it after line { $image }
check-gl-the-texture-bound-here-is-not = the texture bound here is not the one that got its image in line { $image }
check-gl-write-it-right-after-line = write it right after line { $image }
check-gl-the-format-does-not-keep-the = the format { $name } does not keep the colours of the image
check-gl-write-rgb8 = write RGB8
check-gl-the-image-is-passed-to-level = the image is passed to level { $level }, and level 0 stays empty
check-gl-write-level-0 = write level 0
check-gl-is-loaded-but-the-exercise-s = `{ $file }` is loaded, but the exercise's image is `{ $right }`
check-gl-write-tex-image-2d-texture-2d = write `tex_image_2d TEXTURE_2D 0 RGB8 { $image }` after it
check-gl-this-texture-never-gets-an-image = this texture never gets an image

## gl_program/suspects/vertices

check-gl-write-bind-vertex-array-after-it = write `bind_vertex_array { $name }` after it
check-gl-is-created-but-never-bound = `{ $name }` is created but never bound
check-gl-write-array-gen-vertex-array-and = write `array = gen_vertex_array` and `bind_vertex_array array` before it
check-gl-no-vertex-array-is-bound-to = no vertex array is bound to store this setting
check-gl-line-is-meant-for-this-vertex = line { $line } is meant for this vertex array, but comes before it is bound
check-gl-0-unbinds-the-vertex-array-before = 0 unbinds the vertex array before the draw in line { $draw }
check-gl-bind-the-vertex-array-again-before = bind the vertex array again before the draw, or remove this call
check-gl-the-attributes-were-described-in-but = the attributes were described in `{ $name }`, but another vertex array is bound at the draw
check-gl-write-bind-vertex-array = write `bind_vertex_array { $name }`
check-gl-0-unbinds-the-vertex-array-but = 0 unbinds the vertex array, but the calls that follow are meant for it
check-gl-write-bind-buffer-array-buffer-after = write `bind_buffer ARRAY_BUFFER { $buffer }` after it
check-gl-is-created-but-never-bound-to = `{ $buffer }` is created but never bound to ARRAY_BUFFER
check-gl-line-is-meant-for-this-buffer = line { $line } is meant for this buffer, but comes before it is bound
check-gl-0-unbinds-the-buffer-from-so = 0 unbinds the buffer from { $name }, so the calls that follow have none
check-gl-this-buffer-is-not-read-from = this buffer is not read from { $name }
check-gl-write-buffer-data-array-buffer-static = write `buffer_data ARRAY_BUFFER { $data } STATIC_DRAW` after it
check-gl-this-buffer-never-gets-any-bytes = this buffer never gets any bytes
check-gl-stride = stride { $stride }
check-gl-offset = offset { $offset }
check-gl-size = size { $size }
check-gl-has-but-the-data-needs = `{ $attribute }` has { $was }, but the data needs { $is }
check-gl-described-here-but-never-enabled = { $names }: described here, but never enabled
check-gl-write-enable-vertex-attrib-array-after = write `enable_vertex_attrib_array { $name }` after it
check-gl-is-disabled-before-the-draw-in = `{ $attribute }` is disabled before the draw in line { $draw }
check-gl-write-vertex-attrib-pointer-float-false = write `vertex_attrib_pointer { $name } { $size } FLOAT FALSE { $stride } { $offset }`
check-gl-no-vertex-attrib-pointer-says-where = no vertex_attrib_pointer says where `{ $name }` is
check-gl-the-program-has-no-attribute-and = the program has no attribute `{ $wrong }`, and `{ $meant }` gets no data
check-gl-is-used-here-but-is-never = `{ $name }` is used here, but `{ $meant }` is never described
check-gl-the-buffer-is-filled-with-but = the buffer is filled with `{ $data }`, but the corners are in `{ $other }`
check-gl-does-not-contain-the-exercise-s = `{ $name }` does not contain the exercise's numbers
check-gl-restore-the-original-numbers = restore the original numbers

## baking/answer

check-baking-the-picture-has-x-texels-at = the picture has { $width } x { $height } texels; at most { $most } x { $most } are checked, bake a smaller one
check-baking-the-pictures-of-this-folder-are = the pictures of this folder are too large together; hand in the baked one alone

## baking/findings

check-baking-has-triangles = { $name } has { $triangles } triangles
check-baking-triangles-of-are-not-in-the = { $extra } triangles of { $name } are not in the original model
check-baking-the-model-is-times-as-large = the model is { $scale } times as large as the original
check-baking-the-model-is-in-another-place = the model is in another place than the original
check-baking-their-area-is-times-that-of = their area is { $area } times that of the picture
check-baking-of-the-texels = { $conflicts } % of the texels, { $both }
check-baking-charts-overlap-but-only-where-they = charts overlap, but only where they have the same colour
check-baking-of-them = { $outside } % of them
check-baking-some-texture-coordinates-are-outside-of = some texture coordinates are outside of 0 to 1; the picture is right there because it repeats
check-baking-of-a-lookup-at-a-border = { $share } % of a lookup at a border
check-baking-x-texels-of-the-surface-has = { $width } x { $height } texels, { $share } % of the surface has another colour
check-baking-x-texels-are-few-details-are = { $width } x { $height } texels are few: details are lost; 1024 x 1024 keeps them
check-baking-is-transparent-on-the-surface-programs = { $name } is transparent on the surface: programs that use its alpha show holes; save it as RGB

## baking/materials

check-baking-instead-of = { $path } instead of { $chosen }
check-baking-and-the-file-s-name-differ = { $path } and the file's name differ in case: Linux does not find it
check-baking-material-has-a-factor-of-beside = material { $name } has a factor of { $factor } beside its texture: programs that multiply them show it darker; write Kd 1 1 1

## baking/original

check-baking-only-built-in-files-can-be = only built-in files can be read here
check-baking-the-exercise-s-file-was-not = the exercise's file { $path } was not downloaded
check-baking-the-exercise-has-no-model-to = the exercise has no model to bake

## baking/verdict

check-baking-no-model-handed-in = there is no model among the files: hand in the .obj with its .mtl and the baked picture, or a .glb
check-baking-there-are-models-among-the-files = there are { $count } models among the files; check one at a time
check-baking-no-model = there is no model among the files
check-baking-the-picture-of-is-right-everywhere = the picture of { $name } is right everywhere on the model
check-baking-the-colours-of-one-part = the colours of one part
check-baking-not-read = not read: { $reason }
check-baking-of-the-surface-has-the-right = { $percent } % of the surface has the right colour; no known mistake explains the others ({ $parts })

## cubemap

check-cubemap-there-are-pictures-among-the-files = there are { $count } pictures among the files; hand in six faces
check-cubemap-hand-in-the-six-faces-as = { $name }: hand in the six faces as PNG or JPEG
check-cubemap-there-are-no-faces-among-the = there are no faces among the files: hand in six pictures, posx.png to negz.png
check-cubemap-the-faces-must-be-square-and = the faces must be square and of the same size; one has { $width } x { $height } pixels, another { $width2 } x { $height2 }
check-cubemap-the-faces-have-x-pixels-at = the faces have { $size } x { $size } pixels; at least { $least } x { $least } are needed
check-cubemap-the-faces-have-x-pixels-much = the faces have { $size } x { $size } pixels: much of the panorama's detail is lost; { $natural } x { $natural } would keep it
check-cubemap-the-exercise-has-no-panorama-hand = the exercise has no panorama; hand yours in with the faces
check-cubemap-is-not-a-panorama = { $name } is not a panorama
check-cubemap-has-x-pixels-which-is-neither = { $name } has { $width } x { $height } pixels, which is neither a cross nor a strip of six faces; hand in posx.png to negz.png
check-cubemap-was-read-as-a = { $name } was read as a { $arrangement }

## preview/files

check-preview-none-of-these-files-is-an = none of these files is an answer: { $id } reads { $kind }
check-preview-and-more = {" "}and { $more } more
check-preview-ignored-reads = ignored: { $names }{ $more }; { $id } reads { $reads }
check-preview-a-scene = a scene
check-preview-a-model = a model
check-preview-is-leave-the-exercises-with-the = { $name } is { $what }: leave the exercises with the arrow at the top left, and open it there
check-preview-there-is-no-shader-in-reads = there is no shader in { $name }: { $id } reads { $reads }
check-preview-does-not-read-it-reads = { $id } does not read { $name }: it reads { $reads }
check-preview-reads-shaders = a vertex and a fragment shader, in files of any names or as strings of a program, and names.toml
check-preview-reads-shaders-or-faces = a vertex and a fragment shader, or six faces as pictures
check-preview-a-vertex-buffer-csv-tsv-json = a vertex buffer (.csv, .tsv, .json, or raw floats as .bin, .raw or .f32)
check-preview-gl-programs-txt = GL programs (.txt)
check-preview-a-model-with-its-materials-and = a model with its materials and its picture (.obj, .mtl and .png, or .glb)

## preview/mod

check-preview-the-exercise-about-skyboxes-is-missing = the exercise about skyboxes is missing

## preview/pair

check-preview-names-toml-mentions-which-the-shaders = names.toml mentions `{ $name }`, which the shaders do not use

## preview/renderer

check-preview-the-exercise-s-sky = the exercise's sky
check-preview-from-the-mesh = from the mesh
check-preview-0-0-0-1-not-in = 0 0 0 1: not in the mesh
check-preview-a-value = a value
check-preview-unit-0-gonio-s-sky = unit 0: gonio's sky
check-preview-unit-1-white = unit 1: white

## preview/scene

check-preview-lab-pyramid = the lab's own: a pyramid at the origin
check-preview-the-pyramid-turned-and-moved-within = the pyramid turned and moved within a globe of many colours, seen by a camera that is turned as well
check-preview-lab-lamp = the lab's own: a sphere at half its size, and a lamp that swings
check-preview-lab-spheres = the lab's own: a sphere of few triangles, one of more, one of many
check-preview-a-ring-that-is-stretched-turned = a ring that is stretched, turned and moved: it shows normals multiplied by M, and matrices in the wrong order
check-preview-a-ring-stretched-and-turned-its = a ring, stretched and turned: its normals are nothing like its positions
check-preview-a-smooth-sphere-under-the-lab = a smooth sphere under the lab's sky
check-preview-the-sky-seen-by-a-camera = the sky, seen by a camera away from the origin: a sky that comes nearer is wrong

## step/endless

check-step-this-loop-never-ends = this loop never ends
check-step-the-loop-in-line-of-never = the loop in line { $line } of { $file } never ends

## step/pair

check-step-gonio-cannot-run-on-the-cpu = gonio cannot run { $construct } on the CPU
check-step-rewrite-this-part-without-it-to = rewrite this part without it to step through the shader

## step/picture

check-step-black-is-and-white-is = black is { $least } and white is { $greatest }
check-step-black-is-false-and-white-is = black is false and white is true
check-step-colour = red, green and blue are its components, from 0 to 1
check-step-direction = red, green and blue are (x + 1) / 2 of its components, from -1 to 1
check-step-range = red, green and blue are its components, from { $least } to { $greatest }
check-step-there-is-no-expression-point-at = { $file }:{ $line }:{ $column }: there is no expression; point at a name or an operator
check-step-the-shader-does-not-end = ; the shader does not end
check-step-choose-another-expression = ; choose another expression
check-step-no-pixel-evaluates = { $file }:{ $line }:{ $column }: no pixel evaluates `{ $text }`{ $why }
check-step-has-the-type-choose-a-number = { $file }:{ $line }:{ $column }: `{ $text }` has the type { $written }; choose a number or a vector, such as a member of it or a column

## step/user_picture

check-step-the-shader-does-not-end-here = { $file }:{ $line }: the shader does not end here within the time that the CPU gives it; shorten its loops

## step/value

check-step-and-more = , and { $left } more

## check

check-there-is-no-buffer-among-the = there is no buffer among the files: hand in a .csv, .json or .bin as text.md describes
check-there-are-buffers-among-the-files = there are { $count } buffers among the files; check one at a time
check-the-buffer-resembles-none-of-the = the buffer resembles none of the exercise's models; name the file after its model, for example cube.csv
check-all-triangles-of-are-right = all { $count } triangles of { $model } are right
check-mistakes-of-model = { $names } (of { $model })
check-of-the-triangles-of-are-right = { $percent } % of the triangles of { $model } are right; no known mistake explains the others
check-there-is-no-gl-program-among = there is no GL program among the files: hand in a .txt as text.md describes
check-there-are-gl-programs-among-the = there are { $count } GL programs among the files; check one at a time

## class

check-a-system-file-not-a-student = a system file, not a student's
check-it-is-beside-the-submissions-not = it is beside the submissions, not in one of them
check-it-contains-no-answer = it contains no answer
check-an-earlier-attempt-of-the-same = an earlier attempt of the same student


## Names of test scenes and terms, by their ids in verdicts

check-scene-name-lab = lab
check-scene-name-stretched = stretched
check-scene-name-coarse = coarse
check-scene-name-behind = behind
check-scene-name-near = near
check-scene-name-middle = middle
check-scene-name-far = far
check-scene-name-turned = turned
check-scene-name-coloured = coloured
check-scene-name-two-lights = two lights
check-scene-name-second-light = second light
check-scene-name-front = front
check-scene-name-ahead = ahead
check-scene-name-right = right
check-scene-name-moved = moved
check-scene-name-up = up
check-scene-name-above = above
check-scene-name-tilted = tilted
check-scene-name-off-centre = off centre
check-scene-name-to-the-right = to the right
check-scene-name-close = close
check-scene-name-face = face
check-scene-alone = { $scene }, { $term } alone
check-term-ambient = ambient
check-term-diffuse = diffuse
check-term-specular = specular

## Exercises of a teacher's course
check-differs-from-the-reference-in = the picture differs from the reference's in: { $scenes }
check-input-of-the-reference-not-read = the reference reads { $names }; this program reads nothing with that meaning
check-reference-does-not-compile = the exercise's own reference does not compile on this driver: { $error }
check-scene-of-course = a scene of this exercise's own
check-stored-pictures-damaged = the stored pictures of the reference are damaged; package the exercise again
check-stored-pictures-other-scenes = the stored pictures of the reference are of other test scenes, made by another version of gonio or before the exercise changed; package the exercise again
check-points = { $earned } of { $most } points
