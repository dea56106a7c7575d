# check

## check/by_values

check-no-attribute-looks-like-the-position = aucun attribut ne ressemble à la position : nommez-le `position` ou donnez-lui ce rôle dans names.toml
check-the-output-is-not-the-vertex = la sortie n'est pas la couleur des sommets (`color`) ; seules les positions, sujet de cet exercice, ont été comparées ; les images montrent des distances
check-the-lookup-is-right-in-every = la lecture est juste dans toutes les scènes ; sa couleur est modifiée ensuite
check-lookup-mixed = La couleur de la cubemap est mélangée à d'autres couleurs ; les images ne montrent que la lecture
check-only-the-lookup-was-judged = la couleur de la cubemap est mélangée à d'autres couleurs ; seule la lecture a été jugée, et ce sont les images de la lecture
check-the-sky-has-a-depth-of-its-own = le ciel est plus proche que la profondeur maximale (z = w) ; les objets au-delà de son cube sont donc cachés, sauf s'il est dessiné en premier, sans écrire la profondeur
check-the-diffuse-light-is-drawn-in = La lumière diffuse est dessinée par paliers (ombrage « toon »)
check-the-light-is-limited-at-the-vertices = Le vertex shader limite la lumière à 1, avant son interpolation
check-all-but-one-of-the-object = toutes les couleurs de l'objet sauf une sont blanches
check-right-in-every-test-scene-provided = juste dans toutes les scènes de test, à condition que : { $assumptions }
check-right-in-every-scene = juste dans toutes les scènes
check-right-in-every-scene-by-another = juste dans toutes les scènes, par une autre méthode
check-the-picture-differs-from-the-reference = l'image diffère de la référence, mais la signification de { $names } est inconnue : indiquez-la dans names.toml
check-no-known-mistake-explains-the-difference = aucune erreur connue n'explique la différence avec la référence dans : { $scenes }
check-the-program-sends-without-its-translation = le programme envoie `{ $name }` sans sa translation
check-assumed-role = `{ $name }` est `{ $role }`
check-with-this-value-every-test-scene = Avec cette valeur, toutes les scènes de test sont justes.

## check/corrections

check-nothing-is-drawn-check-the-value = rien n'est dessiné : vérifiez la valeur de gl_Position
check-the-picture-is-black-in-every = l'image est noire dans toutes les scènes : cherchez un vecteur, une couleur ou une intensité qui vaut 0 à tort
check-every-pixel-is-nan-in-every = tous les pixels sont NaN dans toutes les scènes : cherchez une division de 0 par 0, ou un vecteur de longueur 0 qui est normalisé
check-the-picture-has-a-single-colour = l'image a une seule couleur dans toutes les scènes : aucun terme ne dépend de la position ni de la normale

## check/mod

check-cannot-be-checked-yet = { $id } ne peut pas encore être vérifié
check-the-picture-is-right-here-only = { $name } ; ici, l'image n'est juste que par hasard
check-unchanged-start-files-with-mistake = ce sont les fichiers de départ, inchangés ; { $name }
check-unchanged-start-files = ce sont les fichiers de départ, inchangés
check-right-by-the-standard-of-the = juste selon les solutions du TP

## comparison/conclusion

check-pixels-are-nan-or-infinite-look = { $undefined } pixels sont NaN ou infinis : cherchez une division par 0, ou la racine carrée ou une puissance d'un nombre négatif
check-the-light-is-computed-for-each = L'éclairage est calculé pour chaque sommet (ombrage de Gouraud)

## comparison/mod

check-a-loop-in-a-shader-never = une boucle d'un shader ne se termine jamais

## feedback

check-a-value-is-wrong-in-a = Une valeur est fausse, d'une façon qui n'est dans aucune liste
check-the-answer-is-not-right = la réponse n'est pas juste
check-of-test-scenes-are-right = { $right } scènes de test justes sur { $all }

## proposed_fix

check-with-this-change-every-test-scene = Avec cette modification, toutes les scènes de test sont justes.
check-with-these-changes-every-test-scene = Avec ces modifications, toutes les scènes de test sont justes.

## source/analysis

check-pow-of-a-negative-number-is = `pow` d'un nombre négatif n'est pas défini : mettez `max` à l'intérieur, `pow(max(dot(R, V), 0.0), shininess)`
check-with-mipmaps-a-seam-would-appear = avec des mipmaps, une couture apparaîtrait derrière la caméra, là où u saute de 1 à 0 ; `textureLod(panorama, place, 0.0)` l'évite

## verdict

check-also =  ; aussi :{" "}
check-the-check-did-not-finish-within = la vérification ne s'est pas terminée en { $seconds } secondes ; y a-t-il dans un shader une boucle qui ne se termine jamais ?
check-the-check-crashed-the-graphics-driver = la vérification a planté : le pilote graphique ne peut ici ni compiler ni exécuter ce shader
check-the-check-was-stopped-because-it = la vérification a été arrêtée car elle occupait plus d'un gigaoctet de mémoire ; y a-t-il un tableau géant ?

## compile

check-compiler-other-compilers-may-reject-it = { $file }:{ $line }: { $message } ; d'autres compilateurs peuvent le refuser

## driver_log/mod

check-compiler-did-you-mean = Vouliez-vous écrire `{ $word }` ?
check-compiler-line-ends-without-a-semicolon = La ligne { $line } se termine sans point-virgule : `{ $code }`.

## panorama/mod

check-panorama-the-shaders-do-not-read-a = les shaders ne lisent aucun panorama : déclarez `uniform sampler2D panorama;`
check-panorama-face-shows-what-belongs-on = La face { $face } montre ce qui va sur { $shown }
check-panorama-the-order-of-opengl-s-faces = L'ordre des faces dans OpenGL est +X, -X, +Y, -Y, +Z, -Z.
check-panorama-all-six-faces-are-right = les six faces sont justes
check-panorama-no-face-is-right-and-no = aucune face n'est juste, et aucune erreur connue n'explique les faces
check-panorama-no-known-mistake-explains-the = aucune erreur connue n'explique { NUMBER($count) ->
        [one] la face { $faces }
       *[other] les faces { $faces }
    }
check-panorama-they-have-of-the-panorama-s = { $name } : elles ont { $sharpness } % de la netteté du panorama

## submission/choose

check-submission-line = { $file } ligne { $line }
check-submission-there-are-several-shaders-and-were = il y a plusieurs shaders : { $all } ; { $vertex } et { $fragment } ont été vérifiés. Si ce n'est pas la bonne paire, rendez seulement la bonne, ou nommez-la.

## submission/mod

check-submission-inserts-values-into-with-gonio-left = { $name } insère des valeurs dans `{ $variable }` avec ${"{"}...{"}"} ; gonio les a laissées de côté.
check-submission-neither-the-name-nor-the-content = ni le nom ni le contenu de { $name } ne montrent son étape : lu comme { $stage } shader.
check-submission-is-named-like-a-vertex-shader = { $file } a le nom d'un vertex shader, mais produit une couleur et pas de gl_Position : lu comme fragment shader. Renommez-le.

## submission/stage

check-submission-what-only-a-fragment-shader-has = ce que seul un fragment shader contient
check-submission-is-named-like-a-shader-but = { $shown } a le nom d'un { $named } shader, mais contient { $because } : lu comme { $content } shader. Renommez-le.

## submission/text

check-submission-begins-with-a-byte-order-mark = { $file } commence par une marque d'ordre des octets (BOM), que certains compilateurs refusent ; gonio l'a ignorée. Enregistrez le fichier en UTF-8 sans BOM.
check-submission-is-utf-16-which-no-glsl = { $file } est en UTF-16, qu'aucun compilateur GLSL ne lit ; gonio l'a converti. Enregistrez le fichier en UTF-8.
check-submission-broken-utf-16 = UTF-16 endommagé
check-submission-zeros-in-utf-16-text = des zéros dans un texte en UTF-16
check-submission-a-zero-byte-at-offset = un octet nul en position { $offset }
check-submission-invalid-utf-8-at-offset = UTF-8 non valide en position { $offset }
check-submission-is-not-utf-8-gonio-read = { $file } n'est pas en UTF-8 ; gonio l'a lu en Latin-1. Enregistrez le fichier en UTF-8, ou écrivez les commentaires sans accents.

## roles/file

check-inputs-names-toml-line = names.toml, ligne { $line } : { $message }
check-inputs-must-be-a-list-of-1 = `{ $name }` doit être une liste de 1 à 16 nombres, par exemple [1.0, 0.5, 0.0]
check-inputs-must-be-a-role-such-as = `{ $name }` doit être un rôle tel que "light-pos", un nombre ou une liste de nombres

## roles/mod

check-inputs-by-its-name = d'après son nom
check-inputs-by-its-type = d'après son type
check-inputs-by-its-name-and-its-neighbours = d'après son nom et ses voisins
check-inputs-by-names-toml = d'après names.toml

## roles/role

check-inputs-unknown-role-did-you-mean = rôle inconnu `{ $word }` : vouliez-vous écrire `{ $nearest }` ?

## user_shaders/inputs

check-inputs-the-first-light-s = première lumière : { $what }
check-inputs-the-second-light-s = deuxième lumière : { $what }
check-inputs-light-s = lumière { $more } : { $what }
check-inputs-the-object-s-matrix-m = la matrice M de l'objet
check-inputs-the-camera-s-matrix-v = la matrice V de la caméra
check-inputs-the-camera-s-matrix-p = la matrice P de la caméra
check-inputs-v-m-of-object-and-camera = V M de l'objet et de la caméra
check-inputs-the-camera-s-p-v = P V de la caméra
check-inputs-p-v-m-of-object-and = P V M de l'objet et de la caméra
check-inputs-the-object-s-inverse-transpose-of = la transposée de l'inverse de M de l'objet
check-inputs-the-inverse-transpose-of-v-m = la transposée de l'inverse de V M
check-inputs-the-inverse-of-the-object-s = l'inverse de la matrice M de l'objet
check-inputs-the-inverse-of-the-camera-s = l'inverse de la matrice V de la caméra
check-inputs-the-inverse-of-v-m = l'inverse de V M
check-inputs-the-camera-s-matrix-v-without = la matrice V de la caméra sans sa translation
check-inputs-the-camera-s-p-v-without = P V de la caméra sans la translation
check-inputs-from-the-camera = de la caméra
check-inputs-from-the-camera-in-degrees = de la caméra, en degrés
check-inputs-position-in-view-space = position dans l'espace de la caméra
check-inputs-direction-in-view-space = direction dans l'espace de la caméra
check-inputs-position = position
check-inputs-direction = direction
check-inputs-colour = couleur
check-inputs-strength = intensité
check-inputs-attenuation = atténuation
check-inputs-half-vector = demi-vecteur
check-inputs-the-ambient-light = la lumière ambiante
check-inputs-the-number-of-lights = le nombre de lumières
check-inputs-the-time-in-seconds = le temps en secondes
check-inputs-the-picture-s-size-in-pixels = la taille de l'image en pixels
check-inputs-from-the-material = du matériau

## user_shaders/mod

check-inputs-there-is-neither-a-vertex-nor = il n'y a ni vertex shader ni fragment shader

## user_shaders/names

check-inputs-the-file-is-not-text-in = { $name }:{ $line }: le fichier n'est pas un texte en UTF-8

## user_shaders/stand_in

check-inputs-gonio-s-vertex-shader = vertex shader de gonio
check-inputs-gonio-s-fragment-shader = fragment shader de gonio
check-inputs-gonio-s-vertex-shader-does-not = { $file }:{ $line }:{ $column }: le vertex shader de gonio ne sait pas ce qu'est `{ $name }`, et écrit 0 ; donnez-lui un nom tel que `world_position`, `normal`, `uv` ou `color` ou un rôle dans names.toml, ou ajoutez un vertex shader

## user_shaders/uniforms

check-inputs-1-number = 1 nombre
check-inputs-numbers = { $expected } nombres
check-inputs-uniform-takes-numbers = `{ $name }` est de type { $glsl_type } et demande { $numbers }, pas { $given }
check-inputs-its-initialiser = son initialisation
check-inputs-your-value = votre valeur
check-inputs-not-recognised-a-guess = non reconnu : valeur supposée
check-inputs-invalid-uniform-expected-name-value-value = uniform `{ $text }` non valide : la forme est NOM=VALEUR[,VALEUR...], par exemple scale=2 ou tint=1,0.5,0
check-inputs-invalid-value-of-the-uniform-expected = valeur `{ $word }` non valide pour l'uniform `{ $name }` : il faut un nombre, true, false ou #rrvvbb

## user_shaders/user_inputs

check-inputs-has-no-effect-on-the-picture = n'a aucun effet sur l'image
check-inputs-is-not-in-the-shaders = n'est pas dans les shaders
check-inputs-the-uniform-has-no-effect-on = l'uniform `{ $name }` n'a aucun effet sur l'image ; sa valeur est ignorée
check-inputs-is-a-sampler-texture-gives-it = `{ $name }` est un échantillonneur ; --texture lui donne une image
check-inputs-the-shaders-have-no-uniform-did = les shaders n'ont pas d'uniform `{ $name }` ; vouliez-vous écrire `{ $near }` ?
check-inputs-the-shaders-have-no-uniform-nor = les shaders n'ont pas d'uniform `{ $name }`, ni aucun autre
check-inputs-the-shaders-have-no-uniform-they = les shaders n'ont pas d'uniform `{ $name }` ; ils ont { $names }
check-inputs-the-shaders-have-no-sampler-did = les shaders n'ont pas d'échantillonneur `{ $name }` ; vouliez-vous écrire `{ $near }` ?
check-inputs-the-shaders-have-no-sampler-nor = les shaders n'ont pas d'échantillonneur `{ $name }`, ni aucun autre
check-inputs-the-shaders-have-no-sampler-they = les shaders n'ont pas d'échantillonneur `{ $name }` ; ils ont { $names }
check-inputs-the-material-s-colour-texture = la texture de couleur du matériau
check-inputs-the-material-s-specular-texture = la texture spéculaire du matériau
check-inputs-the-material-s-normal-map = la texture de normales du matériau
check-inputs-the-environment = l'environnement
check-inputs-your-picture = votre image
check-inputs-not-recognised-white = non reconnu : blanc
check-inputs-the-model-has-no-texture-coordinates = le modèle n'a pas de coordonnées de texture ; les shaders lisent 0 à la place
check-inputs-the-scene-has-no-environment-the = la scène n'a pas d'environnement ; les shaders lisent une cubemap noire, et --environment leur en donne une
check-inputs-the-scene-has-no-light-the = la scène n'a pas de lumière ; les shaders en lisent une blanche à la place de la caméra
check-inputs-the-model-has-no-colour-texture = le modèle n'a pas de texture de couleur ; les shaders lisent du blanc à la place
check-inputs-is-an-attribute-which-takes-a = `{ $name }` est un attribut, qui demande un rôle tel que "position", pas une valeur
check-inputs-is-a-sampler-which-takes-a = `{ $name }` est un échantillonneur, qui demande un rôle tel que "diffuse-texture", pas une valeur
check-inputs-all-numbers = { $all } nombres
check-inputs-names-takes-numbers = `{ $name }` est de type { $ty } et demande { $numbers }, pas { $count }
check-inputs-an-attribute = un attribut
check-inputs-a-sampler = un échantillonneur
check-inputs-a-uniform = un uniform
check-inputs-is-which-cannot-have-the-role = `{ $name }` est { $what }, qui ne peut pas avoir le rôle `{ $role }`
check-inputs-the-attribute-is-not-recognised-and = l'attribut `{ $name }` n'est pas reconnu et lit 0, 0, 0, 1 ; des noms tels que `position` le sont, et names.toml lui donne un rôle
check-inputs-the-sampler-reads-white-texture-gives = l'échantillonneur `{ $name }` lit du blanc ; --texture lui donne une image
check-inputs-the-sampler-reads-0-gonio-has = l'échantillonneur `{ $name }` lit 0 : gonio n'a pas de texture pour { $other }

## Quantities of the light equation, with their articles

check-quantity-position = la position
check-quantity-position-in-model-space = la position dans l'espace du modèle
check-quantity-normal = la normale
check-quantity-unit-normal = la normale unitaire
check-quantity-vector-to-light = le vecteur de la surface vers la lumière
check-quantity-direction-to-light = la direction unitaire de la surface vers la lumière
check-quantity-direction-from-light = la direction unitaire de la lumière vers la surface
check-quantity-vector-to-eye = le vecteur de la surface vers l'œil
check-quantity-direction-to-eye = la direction unitaire de la surface vers l'œil
check-quantity-vector-from-eye = le vecteur de l'œil vers la surface
check-quantity-direction-from-eye = la direction unitaire de l'œil vers la surface
check-quantity-reflected-or-refracted-direction = la direction de la lumière réfléchie ou réfractée
check-quantity-looked-up-direction = la direction dans laquelle lire la cubemap
check-quantity-unit-half-vector = le demi-vecteur unitaire
check-quantity-sum-of-directions = la somme des directions vers la lumière et vers l'œil
check-quantity-cosine-of-light = le cosinus entre la normale et la lumière
check-quantity-twice-the-cosine-of-light = le double du cosinus entre la normale et la lumière
check-quantity-normal-times-the-cosine = la normale multipliée par le cosinus entre la normale et la lumière
check-quantity-normal-times-twice-the-cosine = la normale multipliée par le double du cosinus entre la normale et la lumière
check-quantity-cosine-of-eye = le cosinus entre la normale et l'œil
check-quantity-cosine-of-incidence = le cosinus entre la normale et la direction incidente
check-quantity-twice-the-cosine-of-incidence = deux fois le cosinus entre la normale et la direction incidente
check-quantity-normal-times-the-cosine-of-incidence = la normale fois le cosinus entre la normale et la direction incidente
check-quantity-normal-times-twice-the-cosine-of-incidence = la normale fois deux fois le cosinus entre la normale et la direction incidente
check-quantity-squared-ratio = le carré du rapport des indices
check-quantity-squared-sine-of-incidence = le carré du sinus de l'angle d'incidence
check-quantity-squared-cosine-of-refraction = le carré du cosinus de l'angle de réfraction, 1 - rapport^2 (1 - cos^2)
check-quantity-cosine-of-refraction = le cosinus de l'angle de réfraction
check-quantity-position-on-screen-of-the-sky = la position à l'écran : P fois la position tournée par V
check-quantity-turned-position = la position tournée par V
check-quantity-cosine-of-half-vector = le cosinus entre la normale et le demi-vecteur
check-quantity-cosine-of-reflection = le cosinus entre la direction réfléchie et l'œil
check-quantity-sum-of-terms = la somme des termes diffus et spéculaire
check-quantity-cosine-clamped = le cosinus entre la normale et la lumière, au moins 0
check-quantity-highlight-cosine = le cosinus du reflet
check-quantity-highlight-cosine-clamped = le cosinus du reflet, au moins 0
check-quantity-highlight = le cosinus du reflet à la puissance de la brillance
check-quantity-distance-to-light = la distance de la surface à la lumière
check-quantity-attenuation = l'atténuation
check-quantity-ambient-term = le terme ambiant
check-quantity-diffuse-term = le terme diffus
check-quantity-specular-term = le terme spéculaire
check-quantity-diffuse-attenuated = le terme diffus fois l'atténuation
check-quantity-specular-attenuated = le terme spéculaire fois l'atténuation
check-quantity-attenuated-sum = la somme des lumières diffuse et spéculaire, atténuée
check-quantity-sum-of-all-terms = la somme de tous les termes
check-quantity-coloured-sum = la somme de tous les termes fois la couleur du matériau
check-quantity-right-colour = la couleur de la bonne réponse
check-quantity-cubemap-colour = la couleur de la cubemap dans la bonne direction
check-quantity-position-on-screen = la position à l'écran : P V M fois la position
check-quantity-position-of-the-light = la position de la lumière
check-quantity-position-of-the-eye = la position de l'œil
check-quantity-material-s-colour = la couleur du matériau
check-quantity-ambient-strength = l'intensité ambiante
check-quantity-diffuse-strength = l'intensité diffuse
check-quantity-specular-strength = l'intensité spéculaire
check-quantity-attenuation-constant = la constante de l'atténuation
check-quantity-attenuation-linear = le coefficient linéaire de l'atténuation
check-quantity-attenuation-quadratic = le coefficient quadratique de l'atténuation
check-quantity-shininess = la brillance
check-quantity-roughness = la rugosité
check-quantity-pi = π
check-quantity-squared-tangent = le carré de la tangente de l'angle entre la normale et le demi-vecteur
check-quantity-tangent = la tangente de l'angle entre la normale et le demi-vecteur
check-quantity-angle = l'angle entre la normale et le demi-vecteur
check-quantity-square-of-the-roughness = le carré de la rugosité
check-quantity-exponent-of-ward = l'exposant du modèle de Ward
check-quantity-normalisation-of-ward = la normalisation du modèle de Ward, 4 π α²
check-quantity-divisor-of-ward = la normalisation du modèle de Ward fois la racine des cosinus
check-quantity-exponential-of-ward = l'exponentielle du modèle de Ward
check-quantity-root-of-cosines = la racine des cosinus de la lumière et de l'œil
check-quantity-diffuse-brdf = la BRDF diffuse
check-quantity-ward-s-specular-brdf = la BRDF spéculaire de Ward
check-quantity-sum-of-brdfs = la somme des BRDF diffuse et spéculaire
check-quantity-irradiance = la lumière de la lampe que reçoit la surface
check-quantity-ward-without-strength = la BRDF spéculaire de Ward sans son intensité
check-quantity-index-of-refraction = l'indice de réfraction
check-quantity-ratio-of-indices = le rapport des indices de réfraction
check-quantity-product = { $product } fois { $factor }
check-quantity-in-view-space = { $quantity }, dans l'espace de la caméra
check-quantity-interpolated = { $quantity }, après interpolation

## What an expression should be: the expression, in code, precedes it

check-should-be = devrait être { $quantity }
check-should-have-the-other-sign = devrait avoir le signe opposé
check-should-be-normalised = devrait être normalisé
check-should-be-at-least-zero = devrait être au moins 0
check-should-be-linear = ne devrait pas être élevé à la puissance 1 / 2.2
check-should-be-multiplied = devrait être multiplié par { $quantity }
check-should-be-divided = devrait être divisé par { $quantity }
check-should-be-added = devrait avoir `{ $added }` en plus
check-here-it-is = Ici, c'est { $quantity }.
check-this-should = Ceci { $should } : c'est ici que les valeurs commencent à être fausses.
check-this-is = C'est { $quantity }.
check-this-should-be-after-a-wrong-value = Ceci devrait être { $quantity } ; une valeur précédente est fausse.
check-an-earlier-value-is-wrong = Une valeur précédente est fausse.
check-wrong-value = `{ $text }` { $should }

## Properties that need no reference

check-property-finite = tous les pixels sont finis
    .violated = des pixels sont NaN ou infinis : cherchez une division par 0, ou la racine carrée ou une puissance d'un nombre négatif
check-property-unchanged-when-turned = l'image ne change pas quand le modèle, la lumière et la caméra tournent ensemble
    .violated = l'image change quand le modèle, la lumière et la caméra tournent ensemble : certains vecteurs sont dans des espaces différents
check-property-linear-in-light = la moitié de la lumière donne la moitié de l'image
    .violated = la moitié de la lumière ne donne pas la moitié de l'image : la couleur doit être linéaire en la lumière
check-property-additive-over-lights = l'image avec deux lumières est la somme des images avec chaque lumière seule
    .violated = l'image avec deux lumières n'est pas la somme des images avec chaque lumière seule
check-property-falls-with-distance = la lumière décroît avec la distance comme l'exigent les constantes de l'atténuation
    .violated = la lumière ne décroît pas comme l'exigent les constantes de l'atténuation : doubler les constantes doit diviser la lumière par deux

## Explanations of compilers' messages; NAME is the name in the message, `…` the same without one

check-compiler-frag-color-removed = `gl_FragColor` a disparu avec la version 330 core : déclarez `out vec4 FragColor;` et écrivez dedans.
check-compiler-texture-functions-renamed = `texture2D` et `textureCube` s'appellent `texture` depuis la version 330 core.
check-compiler-attribute-and-varying-removed = `attribute` et `varying` ont disparu avec la version 330 core : écrivez `in` et `out`.
check-compiler-version-not-supported = L'OpenGL de cet ordinateur ne connaît pas ce `#version` : écrivez `#version 330 core`, que tous les pilotes acceptent.
check-compiler-version-not-first = `#version` doit être la première ligne du shader ; seuls des commentaires et des lignes vides peuvent la précéder.
check-compiler-no-main = Il n'y a pas de `void main()` : tout shader en a besoin, écrit exactement ainsi.
check-compiler-position-not-written = Le vertex shader n'écrit jamais dans `gl_Position`, la position du sommet.
check-compiler-not-an-array = Des crochets suivent ce qui n'est ni un tableau, ni un vecteur, ni une matrice.
check-compiler-array-without-size = Un tableau demande une taille constante à sa déclaration : `vec3 lights[4];`.
check-compiler-index-out-of-range = L'indice est hors limites : le premier élément a l'indice 0, et le dernier la taille moins 1.
check-compiler-no-such-member = Ce qui suit le point n'est ni une composante ni un membre : un vec3 a x, y, z (ou r, g, b) mais pas de w ; une struct n'a que les membres qu'elle déclare.
check-compiler-too-many-values = Trop de valeurs entre les parenthèses : vec3 prend trois nombres, ou des vecteurs ayant trois composantes en tout.
check-compiler-too-few-values = Trop peu de valeurs entre les parenthèses : vec4 prend quatre nombres, par exemple `vec4(v, 1.0)` pour un vec3 v.
check-compiler-initialiser-of-another-type = La valeur de droite n'a pas le type de la variable de gauche : convertissez-la, par exemple avec `vec3(v4)` ou `v4.xyz` pour un vec4, `vec4(v3, 1.0)` pour un vec3.
check-compiler-read-only = `{ $name }` ne peut pas être modifié : les variables `in`, `uniform` et `const` sont en lecture seule. Copiez-le dans une variable à vous et modifiez celle-ci.
    .unnamed = Cette variable ne peut pas être modifiée : les variables `in`, `uniform` et `const` sont en lecture seule. Copiez-la dans une variable à vous et modifiez celle-ci.
check-compiler-no-function-for-these-types = Aucune fonction `{ $name }` ne prend des arguments de ces types : vérifiez le type de chacun. `dot`, `reflect`, `cross` et `max` prennent deux arguments du même type (vec3 et vec3), `texture` prend un échantillonneur et un vec2 (un vec3 pour une cubemap).
    .unnamed = Aucune fonction ne prend des arguments de ces types : vérifiez le type de chacun. `dot`, `reflect`, `cross` et `max` prennent deux arguments du même type (vec3 et vec3), `texture` prend un échantillonneur et un vec2 (un vec3 pour une cubemap).
check-compiler-not-written-by-vertex-shader = Le fragment shader lit `{ $name }`, mais le vertex shader n'a pas de `out` de ce nom : les deux doivent avoir le même nom et le même type.
    .unnamed = Le fragment shader lit une variable dont le vertex shader n'a pas de `out` : les deux doivent avoir le même nom et le même type.
check-compiler-varying-of-two-types = `{ $name }` est déclaré dans les deux étapes avec des types différents : le `out` du vertex shader et le `in` du fragment shader doivent correspondre.
    .unnamed = Cette variable est déclarée dans les deux étapes avec des types différents : le `out` du vertex shader et le `in` du fragment shader doivent correspondre.
check-compiler-flat-in-one-stage = `flat` doit être écrit dans les deux étapes ou dans aucune ; un varying entier l'exige.
check-compiler-uniform-of-two-types = L'uniform `{ $name }` est déclaré dans les deux étapes avec des types différents : les types doivent correspondre.
    .unnamed = L'uniform est déclaré dans les deux étapes avec des types différents : les types doivent correspondre.
check-compiler-declared-twice = `{ $name }` est déclaré deux fois au même endroit : supprimez une déclaration, ou changez son nom.
    .unnamed = Cette variable est déclarée deux fois au même endroit : supprimez une déclaration, ou changez son nom.
check-compiler-reserved-name = `{ $name }` est réservé en GLSL (comme `input`, `output`, `sample`, `filter`, `texture`, et les noms avec `gl_` ou deux tirets bas) : donnez-lui un autre nom.
    .unnamed = Ce nom est réservé en GLSL (comme `input`, `output`, `sample`, `filter`, `texture`, et les noms avec `gl_` ou deux tirets bas) : choisissez-en un autre.
check-compiler-division-by-zero = Une constante est divisée par zéro ici.
check-compiler-operands-do-not-match = Les deux côtés de l'opérateur ne vont pas ensemble : les vecteurs doivent avoir la même taille (vec3 avec vec3), une mat4 multiplie un vec4 (écrivez `vec4(v, 1.0)`), et les float s'écrivent avec un point décimal (`2.0` au lieu de `2`).
check-compiler-integer-instead-of-float = Il faut un float, et c'est un entier : écrivez-le avec un point décimal, `2.0` au lieu de `2`.
check-compiler-different-types = La valeur et la variable ont des types différents : prenez quelques composantes de la valeur (`v4.xyz`, `vec3(v4)`) ou ajoutez celles qui manquent (`vec4(v3, 1.0)`).
check-compiler-returned-type = La valeur renvoyée n'a pas le type de retour de la fonction.
check-compiler-condition-not-bool = Une condition doit être un bool : écrivez une comparaison, par exemple `if (x > 0.0)`.
check-compiler-sampler-not-uniform = Un échantillonneur ne peut être qu'un `uniform` ou un paramètre de fonction, pas une variable ni un varying.
check-compiler-no-precision = GLSL ES exige une précision : écrivez `precision mediump float;` sous le `#version`.
check-compiler-qualifier-not-allowed = Cette déclaration a un qualificatif qui n'est pas permis ici : `in`, `out` et `uniform` s'écrivent hors des fonctions, une fois chacun, et `layout(location = 0)` devant un `in` de fragment shader demande la version 410.
check-compiler-read-before-assigned = `{ $name }` est lu avant de recevoir une valeur.
    .unnamed = Une variable est lue avant de recevoir une valeur.
check-compiler-recursion = Une fonction s'appelle elle-même, ce que GLSL ne permet pas.
check-compiler-include = GLSL n'a pas de `#include` : collez ici le texte de ce fichier.
check-compiler-extension-missing = Le pilote graphique n'a pas cette extension : supprimez la ligne `#extension`.
check-compiler-character-not-allowed = Il y a un caractère que GLSL ne permet pas, peut-être un guillemet, un tiret ou un espace copié d'une page web ou d'un traitement de texte : retapez-le.
check-compiler-file-ends-too-early = Le fichier se termine trop tôt : il manque un `{"}"}`, un `*/` ou un `#endif`.
check-compiler-not-linked = L'édition des liens est impossible car l'un des shaders n'a pas été compilé : corrigez d'abord celui-ci.
check-compiler-undeclared = `{ $name }` n'est pas déclaré ici : déclarez-le (`uniform`, `in`, ou une variable avant cette ligne), ou vérifiez son orthographe, majuscules comprises.
    .unnamed = Ce nom n'est pas déclaré ici : déclarez-le (`uniform`, `in`, ou une variable avant cette ligne), ou vérifiez son orthographe, majuscules comprises.
check-compiler-syntax = Le compilateur ne comprend pas ceci. Souvent, il manque un point-virgule ou une parenthèse à la fin de la ligne précédente.

## Terms of later exercises

check-ambient-added = Une lumière ambiante est ajoutée, que l'exercice ne demande pas
check-highlight-added = Un reflet est ajouté, que l'exercice ne demande pas

## What the faces of a cubemap show

check-panorama-shows-posx = à droite : s va vers -Z, t vers -Y
check-panorama-shows-negx = à gauche : s va vers +Z, t vers -Y
check-panorama-shows-posy = en haut : s va vers +X, t vers +Z
check-panorama-shows-negy = en bas : s va vers +X, t vers -Z
check-panorama-shows-posz = derrière : s va vers +X, t vers -Y
check-panorama-shows-negz = droit devant : s va vers -X, t vers -Y

## submission/error

check-submission-list-and-more = { $names } et { $more } autres
check-submission-ignored = {"ignoré : "}
check-submission-no-files = il n'y a pas de fichiers : rendez un vertex shader et un fragment shader
check-submission-empty-file = { $file } est vide : enregistrez le shader dans votre éditeur et rendez-le de nouveau
check-submission-binary-file = { $file } n'est pas un fichier texte ({ $because }) : rendez le code source du shader en texte brut
check-submission-rich-text = { $file } est un document de traitement de texte, pas du texte brut : enregistrez-le en texte brut (.txt) et rendez ce fichier
check-submission-too-large = { $file } fait { $bytes } octets, plus que la limite de { $most } : rendez seulement le code source du shader
check-submission-no-shader = il n'y a pas de shader dans { $files } : rendez un vertex shader et un fragment shader, ou le programme qui contient les deux sous forme de chaînes
check-submission-missing-stage = le { $missing } shader manque ; trouvé seulement { $found } ({ $stage }) : rendez les deux étapes
check-submission-same-stage-twice = { $found } sont tous de type { $stage } shader, et il n'y a pas de { $missing } shader : rendez-en un de chaque
check-submission-missing-include = { $file }:{ $line }: `{ $included }` est inclus et n'est pas parmi les fichiers : rendez-le aussi, ou collez son texte ici
check-submission-no-such-pair = aucune paire de shaders ne s'appelle `{ $requested }` : choisissez parmi { $candidates }
check-own-shader-does-not-compile = le shader de gonio lui-même n'est pas compilé par ce pilote : { $error }

## Test scenes: what each shows that others do not

check-scene-lab = la scène du TP : une sphère à la moitié de sa taille
check-scene-stretched = un modèle étiré, tourné et déplacé
check-scene-coarse = une sphère grossière près de la lumière
check-scene-behind = la lumière derrière l'objet
check-scene-distances = la même lumière à trois distances, avec une forte lumière ambiante
check-scene-turned = une autre caméra, tournée et inclinée
check-scene-coloured = un autre matériau, de couleur vive
check-scene-two-lights = deux lumières de positions et d'intensités différentes
check-scene-second-light = la seconde de deux lumières, seule
check-scene-one-term = un seul terme
check-scene-coarse-mirror = une sphère grossière à la moitié de sa taille, loin de l'origine
check-scene-front = une sphère au milieu
check-scene-sky-ahead = depuis l'origine, droit devant
check-scene-sky-right = depuis l'origine, vers la droite
check-scene-sky-moved = la caméra s'est déplacée
check-scene-sky-up = vers le haut, tête penchée
check-scene-camera-turned = une caméra tournée sur le côté et qui regarde vers le bas
check-scene-camera-above = d'en haut : up et Front sont loin d'être perpendiculaires
check-scene-camera-tilted = une tête penchée : up n'est pas Y
check-scene-camera-off-centre = tout est loin de l'origine, et la caméra regarde à côté
check-scene-camera-lab = la scène du TP : M est l'identité, et la caméra n'est pas tournée
check-scene-camera-to-the-right = la même, avec la caméra déplacée vers la droite
check-scene-camera-behind = de derrière et d'en dessous, vers le haut
check-scene-camera-close = près de la pyramide
check-scene-face = une face d'une cubemap

## Mistakes in GL programs: half a sentence, the rule of OpenGL, the symptom, the fix

check-gl-texture-name-as-unit = l'échantillonneur reçoit le nom de la texture au lieu de son unité
    .explanation = Un échantillonneur prend le numéro d'une unité de texture. Le nom d'une texture est un autre nombre, choisi par OpenGL.
    .looks-like = noir, sans aucune erreur
    .fix = donnez à l'échantillonneur l'unité à laquelle la texture est liée
check-gl-unbound-unit = l'échantillonneur lit une autre unité que celle à laquelle la texture est liée
    .explanation = Un échantillonneur lit du noir dans une unité sans texture, et OpenGL ne signale pas d'erreur.
    .looks-like = noir, sans aucune erreur
    .fix = liez la texture à l'unité que lit l'échantillonneur, ou donnez cette unité à l'échantillonneur
check-gl-active-texture-after-bind = l'unité est activée après la liaison de la texture
    .explanation = bind_texture lie la texture à l'unité active à ce moment.
    .looks-like = noir, sans aucune erreur
    .fix = écrivez active_texture avant bind_texture
check-gl-active-texture-number = active_texture reçoit un simple nombre
    .explanation = Les unités s'appellent TEXTURE0, TEXTURE1 et ainsi de suite ; OpenGL refuse 0 et 1 ici.
    .looks-like = noir, ou la mauvaise texture
    .fix = écrivez TEXTURE0 et ainsi de suite
check-gl-sampler-never-set = l'échantillonneur ne reçoit jamais de valeur, et lit l'unité 0
    .explanation = Un échantillonneur sans valeur lit l'unité 0, mais la texture est liée à une autre unité.
    .looks-like = noir, sans aucune erreur
    .fix = donnez à l'échantillonneur l'unité de la texture, avec uniform_1i après use_program
check-gl-uniform-before-use-program = l'uniform reçoit sa valeur avant que son programme soit utilisé
    .explanation = uniform_1i donne une valeur à un uniform du programme utilisé. Sans programme, OpenGL refuse l'appel, et l'uniform reste à 0.
    .looks-like = noir ; OpenGL signale INVALID_OPERATION
    .fix = appelez d'abord use_program
check-gl-uniform-after-draw = l'uniform reçoit sa valeur après le dessin
    .explanation = Un dessin utilise les valeurs que les uniforms ont à ce moment.
    .looks-like = noir dans la première image
    .fix = donnez-lui sa valeur avant le dessin
check-gl-uniform-name-wrong = le programme n'a pas d'uniform de ce nom
    .explanation = L'emplacement d'un nom inconnu est -1, qu'OpenGL ignore sans erreur.
    .looks-like = comme si l'uniform ne recevait jamais de valeur
    .fix = écrivez le nom comme dans le shader
check-gl-uniform-type-wrong = l'uniform reçoit sa valeur par l'appel destiné à un autre type
    .explanation = Un échantillonneur est un entier : OpenGL refuse uniform_1f pour lui.
    .looks-like = comme si l'uniform ne recevait jamais de valeur
    .fix = utilisez uniform_1i
check-gl-mipmaps-missing = le filtre a besoin de mipmaps, mais il n'y en a pas
    .explanation = Une texture sans les mipmaps dont son filtre a besoin est incomplète, et se lit comme du noir.
    .looks-like = noir, sans aucune erreur
    .fix = appelez generate_mipmap après tex_image_2d, ou utilisez un filtre sans mipmaps
check-gl-filter-never-set = le filtre n'est jamais choisi : celui par défaut a besoin de mipmaps, mais il n'y en a pas
    .explanation = Le filtre de réduction par défaut d'une texture est NEAREST_MIPMAP_LINEAR.
    .looks-like = noir, sans aucune erreur
    .fix = donnez à TEXTURE_MIN_FILTER la valeur LINEAR, ou appelez generate_mipmap
check-gl-mipmaps-before-image = les mipmaps sont calculées avant que l'image soit donnée
    .explanation = generate_mipmap calcule les petits niveaux à partir du contenu du niveau 0 à ce moment.
    .looks-like = noir, sans aucune erreur
    .fix = appelez generate_mipmap après tex_image_2d
check-gl-mipmaps-misplaced = les mipmaps sont calculées pour une autre texture
    .explanation = generate_mipmap agit sur la texture liée à l'unité active à ce moment.
    .looks-like = un triangle noir
    .fix = appelez generate_mipmap juste après tex_image_2d
check-gl-filter-refused = OpenGL refuse le filtre
    .explanation = TEXTURE_MAG_FILTER ne peut être que NEAREST ou LINEAR ; les filtres avec mipmaps sont pour TEXTURE_MIN_FILTER.
    .looks-like = noir, si l'autre filtre a alors besoin de mipmaps
    .fix = donnez ce filtre à TEXTURE_MIN_FILTER
check-gl-wrong-target = la texture est utilisée avec la cible d'un autre genre de texture
    .explanation = Un sampler2D lit la texture liée à TEXTURE_2D, un samplerCube celle liée à TEXTURE_CUBE_MAP.
    .looks-like = un triangle noir
    .fix = écrivez TEXTURE_2D dans tous les appels pour cette texture
check-gl-texture-not-bound = la texture n'est jamais liée
    .explanation = Une texture existe dès qu'elle a été liée, et tous les appels qui la concernent agissent sur la texture liée.
    .looks-like = noir ; OpenGL signale INVALID_OPERATION
    .fix = appelez bind_texture avant les autres appels pour la texture
check-gl-texture-bound-late = la texture est liée après les appels qui lui sont destinés
    .explanation = tex_image_2d et tex_parameter agissent sur la texture liée à ce moment.
    .looks-like = un triangle noir
    .fix = appelez bind_texture avant eux
check-gl-texture-unbound = la texture est déliée avant le dessin
    .explanation = bind_texture avec 0 délie la texture de l'unité.
    .looks-like = noir, sans aucune erreur
    .fix = supprimez cet appel, ou liez de nouveau la texture avant le dessin
check-gl-other-texture-bound = une autre texture est liée à l'unité que lit l'échantillonneur
    .explanation = Une unité a une texture de chaque genre : la dernière liée pendant que l'unité était active.
    .looks-like = une autre image, ou du noir
    .fix = activez une autre unité avant de lier l'autre texture
check-gl-texture-deleted = la texture est supprimée avant le dessin
    .explanation = Supprimer une texture la délie de toutes les unités.
    .looks-like = noir, sans aucune erreur
    .fix = supprimez-la après le dernier dessin qui la lit
check-gl-internal-format-wrong = le format interne de la texture perd ou change ses couleurs
    .explanation = R8 ne garde que le canal rouge ; SRGB8 est décodé à la lecture, et tout est plus sombre.
    .looks-like = rouge, ou trop sombre
    .fix = écrivez RGB8
check-gl-image-level-wrong = l'image est donnée à un autre niveau que 0
    .explanation = Le niveau 0 est l'image entière, et les autres sont ses mipmaps.
    .looks-like = un triangle noir
    .fix = donnez l'image au niveau 0
check-gl-image-missing = la texture ne reçoit jamais d'image
    .explanation = Une texture sans image se lit comme du noir.
    .looks-like = un triangle noir
    .fix = appelez tex_image_2d
check-gl-image-wrong = la mauvaise image est chargée
    .explanation = L'exercice demande un autre fichier.
    .looks-like = un autre motif
    .fix = chargez l'image de l'exercice
check-gl-level-range-wrong = la plage de niveaux ne correspond pas aux niveaux qui existent
    .explanation = TEXTURE_BASE_LEVEL et TEXTURE_MAX_LEVEL définissent quels niveaux font partie de la texture.
    .looks-like = noir, ou flou
    .fix = supprimez ces deux appels
check-gl-stride-wrong = le pas (stride) est faux
    .explanation = Le pas (stride) est le nombre d'octets d'un sommet au suivant : la taille d'un sommet entier dans le tampon.
    .looks-like = pas de triangle, ou un triangle déchiré
    .fix = écrivez la taille d'un sommet entier, en octets
check-gl-offset-wrong = le décalage (offset) d'un attribut est faux
    .explanation = Le décalage (offset) est le nombre d'octets qui précèdent l'attribut dans le premier sommet.
    .looks-like = l'attribut a les valeurs d'un autre
    .fix = comptez les octets de tous les attributs qui le précèdent
check-gl-attribute-size-wrong = l'attribut n'a pas le bon nombre de composantes
    .explanation = La taille est le nombre de composantes par sommet, de 1 à 4 ; celles qui manquent valent 0, 0, 1.
    .looks-like = plat, déchiré, ou d'autres couleurs
    .fix = écrivez le nombre de composantes des données
check-gl-attribute-type-wrong = l'attribut n'a pas le bon type
    .explanation = Le type définit comment OpenGL lit les octets du tampon.
    .looks-like = rien, ou du bruit
    .fix = écrivez FLOAT
check-gl-attribute-not-enabled = l'attribut n'est pas activé
    .explanation = Un attribut qui n'est pas activé a la même valeur pour tous les sommets : (0, 0, 0, 1).
    .looks-like = une couleur partout, un texel partout, ou pas de triangle
    .fix = appelez enable_vertex_attrib_array pour lui
check-gl-attribute-disabled = l'attribut est désactivé avant le dessin
    .explanation = Un attribut qui n'est pas activé a la même valeur pour tous les sommets : (0, 0, 0, 1).
    .looks-like = une couleur partout, un texel partout, ou pas de triangle
    .fix = supprimez disable_vertex_attrib_array
check-gl-attribute-not-described = l'attribut n'est jamais décrit
    .explanation = Sans vertex_attrib_pointer, OpenGL ne sait pas où sont les données de l'attribut.
    .looks-like = pas de triangle
    .fix = appelez vertex_attrib_pointer pour lui
check-gl-attribute-name-wrong = le programme n'a pas d'attribut de ce nom
    .explanation = L'emplacement d'un nom inconnu est -1, qu'OpenGL refuse.
    .looks-like = comme si l'attribut n'était pas activé
    .fix = écrivez le nom comme dans le vertex shader
check-gl-vertex-array-missing = il n'y a pas de vertex array
    .explanation = Dans le profil core d'OpenGL, les attributs ne sont enregistrés que dans des vertex arrays.
    .looks-like = pas de triangle ; OpenGL signale INVALID_OPERATION
    .fix = créez-en un avec gen_vertex_array et liez-le
check-gl-vertex-array-not-bound = le vertex array n'est jamais lié
    .explanation = Les attributs sont enregistrés dans le vertex array lié.
    .looks-like = pas de triangle ; OpenGL signale INVALID_OPERATION
    .fix = appelez bind_vertex_array avant la description des attributs
check-gl-vertex-array-bound-late = le vertex array est lié après la description des attributs
    .explanation = Les attributs sont enregistrés dans le vertex array lié à ce moment.
    .looks-like = pas de triangle
    .fix = appelez d'abord bind_vertex_array
check-gl-vertex-array-unbound = aucun vertex array n'est lié au moment du dessin
    .explanation = Un dessin lit les attributs du vertex array lié.
    .looks-like = pas de triangle ; OpenGL signale INVALID_OPERATION
    .fix = liez de nouveau le vertex array avant le dessin
check-gl-other-vertex-array = un autre vertex array est lié au moment du dessin
    .explanation = Un dessin lit les attributs du vertex array lié.
    .looks-like = pas de triangle, ou un autre
    .fix = liez le vertex array dans lequel les attributs ont été décrits
check-gl-vertex-array-deleted = le vertex array est supprimé avant le dessin
    .explanation = Supprimer un vertex array supprime sa description des attributs.
    .looks-like = pas de triangle
    .fix = supprimez-le après le dernier dessin
check-gl-buffer-not-bound = le tampon n'est jamais lié
    .explanation = buffer_data remplit le tampon lié, et vertex_attrib_pointer s'y réfère.
    .looks-like = pas de triangle
    .fix = appelez d'abord bind_buffer ARRAY_BUFFER
check-gl-buffer-bound-late = le tampon est lié après les appels qui lui sont destinés
    .explanation = buffer_data remplit le tampon lié à ce moment, et vertex_attrib_pointer s'y réfère.
    .looks-like = pas de triangle
    .fix = appelez bind_buffer avant eux
check-gl-buffer-unbound = le tampon est délié avant la description des attributs
    .explanation = vertex_attrib_pointer se réfère au tampon lié à ARRAY_BUFFER à ce moment.
    .looks-like = pas de triangle
    .fix = déliez-le après vertex_attrib_pointer, ou pas du tout
check-gl-buffer-target-wrong = le tampon est lié à la mauvaise cible
    .explanation = Les sommets se lisent dans ARRAY_BUFFER, les indices dans ELEMENT_ARRAY_BUFFER.
    .looks-like = pas de triangle
    .fix = liez les sommets à ARRAY_BUFFER
check-gl-buffer-empty = le tampon n'est jamais rempli
    .explanation = Un tampon est vide tant que buffer_data ne l'a pas rempli.
    .looks-like = pas de triangle
    .fix = appelez buffer_data
check-gl-buffer-deleted = le tampon est supprimé avant le dessin
    .explanation = Supprimer un tampon le détache du vertex array lié.
    .looks-like = pas de triangle
    .fix = supprimez-le après le dernier dessin
check-gl-other-data = le tampon est rempli avec une autre liste
    .explanation = Le dessin lit les dernières données qui ont rempli le tampon.
    .looks-like = une autre forme
    .fix = donnez les coins à buffer_data
check-gl-data-changed = les coins ne sont pas ceux de l'exercice
    .explanation = L'erreur est dans un appel ; les nombres des coins étaient justes.
    .looks-like = un autre triangle, ou d'autres couleurs
    .fix = remettez les nombres d'origine
check-gl-index-type-wrong = les indices n'ont pas le bon type
    .explanation = Le type dans draw_elements est celui des indices dans le tampon : ici UNSIGNED_INT, quatre octets chacun.
    .looks-like = pas de triangle, ou un triangle déchiré
    .fix = écrivez UNSIGNED_INT
check-gl-index-offset-wrong = le dessin commence au mauvais indice
    .explanation = Le dernier argument de draw_elements est un décalage en octets.
    .looks-like = un autre triangle, ou aucun
    .fix = écrivez 0
check-gl-indices-from-one = les indices comptent à partir de 1
    .explanation = Le premier sommet d'un tampon a l'indice 0 ; dans les fichiers .obj, il a l'indice 1.
    .looks-like = un coin manque ou est faux
    .fix = soustrayez 1 à chaque indice
check-gl-indices-changed = les indices désignent d'autres coins
    .explanation = Chaque indice est le numéro d'un coin, à partir de 0.
    .looks-like = un autre triangle
    .fix = écrivez 0 1 2
check-gl-index-buffer-not-bound = aucun tampon d'indices n'est lié dans le vertex array
    .explanation = Un vertex array enregistre l'ELEMENT_ARRAY_BUFFER lié pendant que le vertex array est lié.
    .looks-like = pas de triangle
    .fix = liez le tampon d'indices après le vertex array
check-gl-program-not-used = le programme n'est jamais utilisé
    .explanation = Un dessin exécute le programme utilisé ; l'édition des liens d'un programme ne le choisit pas.
    .looks-like = pas de triangle
    .fix = appelez use_program
check-gl-program-switched-off = aucun programme n'est utilisé au moment du dessin
    .explanation = use_program avec 0 abandonne le programme.
    .looks-like = pas de triangle
    .fix = appelez use_program avec le programme avant le dessin
check-gl-program-number-wrong = use_program reçoit un nombre qui n'est pas un programme
    .explanation = create_program renvoie le numéro d'un programme.
    .looks-like = pas de triangle
    .fix = donnez le nombre que create_program a renvoyé
check-gl-draw-missing = rien n'est dessiné
    .explanation = Sans appel de dessin, il n'y a que le fond.
    .looks-like = pas de triangle
    .fix = appelez draw_arrays
check-gl-draw-count-wrong = le nombre de sommets est faux
    .explanation = Ce nombre est celui des sommets, pas des triangles ni des float.
    .looks-like = pas de triangle, ou une partie
    .fix = écrivez 3
check-gl-draw-first-wrong = le dessin commence au mauvais sommet
    .explanation = Le premier sommet est 0.
    .looks-like = pas de triangle, ou un autre
    .fix = écrivez 0
check-gl-draw-mode-wrong = les sommets sont reliés d'une autre façon
    .explanation = TRIANGLES dessine un triangle pour trois sommets.
    .looks-like = des points ou des segments
    .fix = écrivez TRIANGLES
check-gl-draw-too-early = le dessin précède la mise en place
    .explanation = Un dessin utilise l'état à ce moment ; les appels suivants concernent le dessin d'après.
    .looks-like = pas de triangle, ou un triangle noir
    .fix = dessinez après tout le reste
check-gl-viewport-wrong = le viewport n'est pas toute l'image
    .explanation = viewport définit où l'espace de découpage est placé dans l'image.
    .looks-like = pas de triangle, ou un petit dans un coin
    .fix = donnez-lui 0, 0 et la taille de l'image, ou supprimez-le
check-gl-clear-missing = l'image n'est jamais effacée
    .explanation = Les pixels qui ne sont pas dessinés gardent leur contenu précédent.
    .looks-like = un autre fond
    .fix = appelez clear COLOR_BUFFER_BIT avant le dessin
check-gl-clear-after-draw = l'image est effacée après le dessin
    .explanation = clear efface ce qui a été dessiné.
    .looks-like = seulement le fond
    .fix = effacez d'abord, puis dessinez
check-gl-clear-color-late = la couleur du fond est choisie après clear
    .explanation = clear utilise la couleur choisie à ce moment.
    .looks-like = un autre fond
    .fix = écrivez clear_color avant clear
check-gl-clear-color-wrong = le fond n'a pas la bonne couleur
    .explanation = clear remplit l'image avec la couleur de clear_color.
    .looks-like = un autre fond
    .fix = écrivez clear_color 0.2 0.25 0.3 1.0
check-gl-culled = la face du triangle est éliminée (culling)
    .explanation = Avec CULL_FACE, les faces dont les coins tournent dans le sens horaire ne sont pas dessinées.
    .looks-like = pas de triangle
    .fix = désactivez CULL_FACE, ou inversez l'ordre des coins

## Mistakes in readers of OBJ files: a title, what the program does, the change that fixes it

check-buffer-indices-from-0 = Les indices sont pris comme s'ils comptaient à partir de 0
    .explanation = Un fichier OBJ compte ses sommets, coordonnées de texture et normales à partir de 1. Utilisés comme indices dans un tableau qui commence à 0, ils sont tous décalés de un, et le dernier est hors limites.
    .fix = Soustrayez 1 à chaque indice avant de l'utiliser.
check-buffer-tex-coord-and-normal-swapped = vt et vn sont échangés dans f
    .explanation = Les coins d'une face sont v/vt/vn, dans cet ordre. Ici, le deuxième nombre sert d'indice de la normale et le troisième d'indice de la coordonnée de texture.
    .fix = Utilisez le deuxième nombre d'un coin pour vt, le troisième pour vn.
check-buffer-v-flipped = v est 1 - v
    .explanation = v va du bas vers le haut dans un fichier OBJ, et ici du haut vers le bas. C'est juste si les images sont chargées avec leur première ligne en premier et sans retournement ; sinon, les textures sont à l'envers.
    .fix = Passez v à OpenGL sans le changer et retournez l'image au chargement, stbi_set_flip_vertically_on_load(true) ; ou gardez 1 - v, mais ne faites que l'un des deux.
check-buffer-quads-first-triangle-only = Seulement le premier triangle de chaque polygone
    .explanation = Une face à quatre coins fait deux triangles. Ici, seuls ses trois premiers coins sont lus, et la moitié de chaque quadrilatère manque.
    .fix = Faites un triangle des coins 1, i et i + 1 pour chaque i de 2 à l'avant-dernier.
check-buffer-quads-lost = Les faces de plus de trois coins sont laissées de côté
    .explanation = Seules les faces triangulaires sont dans le tampon ; les quadrilatères et les polygones plus grands manquent.
    .fix = Découpez les polygones en triangles : coins 1, i, i + 1.
check-buffer-quads-as-triangles = Le coin 4 d'un quadrilatère commence le triangle suivant
    .explanation = Tous les coins de toutes les faces forment une liste, dessinée trois par trois en triangles. Après le premier quadrilatère, les triangles relient des coins de faces différentes.
    .fix = Traitez chaque ligne f séparément : découpez-la en triangles avant de lire la suivante.
check-buffer-large-polygons-cut-short = Seulement les quatre premiers coins des grands polygones
    .explanation = Les triangles et les quadrilatères sont justes, mais seuls les quatre premiers coins des faces plus grandes sont lus.
    .fix = Lisez les coins jusqu'à la fin de la ligne, et découpez-les en triangles quel que soit leur nombre.
check-buffer-large-polygons-lost = Les faces de plus de quatre coins sont laissées de côté
    .explanation = Les triangles et les quadrilatères sont dans le tampon ; les faces de cinq coins ou plus manquent.
    .fix = Lisez les coins jusqu'à la fin de la ligne, et découpez-les en triangles quel que soit leur nombre.
check-buffer-concave-polygon-as-fan = Un polygone concave est découpé en éventail
    .explanation = Les triangles des coins 1, i, i + 1 ne couvrent un polygone que s'il n'a pas de coin rentrant. Ici, certains sont à l'extérieur, retournés.
    .fix = Coupez des oreilles : des coins saillants dont le triangle ne contient aucun autre coin. Ou triangulez à l'export de Blender.
check-buffer-normals-by-position = Les normales sont cherchées avec l'indice de la position
    .explanation = Le coin v/vt/vn définit sa normale. Ici, le premier nombre sert aussi pour la normale, et une position a toujours la normale de même indice.
    .fix = Utilisez le troisième nombre d'un coin comme indice de son vn.
check-buffer-tex-coords-by-position = Les coordonnées de texture sont cherchées avec l'indice de la position
    .explanation = Le coin v/vt/vn définit sa coordonnée de texture. Ici, le premier nombre sert aussi pour elle.
    .fix = Utilisez le deuxième nombre d'un coin comme indice de son vt.
check-buffer-vertices-not-split = Une coordonnée de texture et une normale par position
    .explanation = Une position commune à plusieurs faces peut avoir dans chacune une autre normale et une autre coordonnée de texture. Ici, elles sont enregistrées par position, et les valeurs d'un coin remplacent celles de tous les autres.
    .fix = Faites un sommet pour chaque v/vt/vn distinct, pas pour chaque v (ou simplement un par coin).
check-buffer-normals-missing = Les normales ne sont pas celles du fichier : elles sont toutes égales
    .explanation = Le fichier a des normales, mais tous les sommets du tampon ont la même, ou zéro.
    .fix = Lisez les lignes vn, et donnez à chaque coin celle que désigne son troisième nombre.
check-buffer-tex-coords-missing = Les coordonnées de texture ne sont pas celles du fichier : elles sont toutes nulles
    .explanation = Le fichier a des coordonnées de texture, mais tous les sommets du tampon ont (0, 0).
    .fix = Lisez les lignes vt, et donnez à chaque coin celle que désigne son deuxième nombre.
check-buffer-negative-as-positive = Le signe des indices négatifs est perdu
    .explanation = -1 désigne le dernier sommet avant la ligne, -2 celui d'avant. Ici, le signe moins est perdu, et l'indice compte depuis le début.
    .fix = Si un indice est négatif, ajoutez-lui le nombre de sommets (ou de vt, ou de vn) déjà lus.
check-buffer-negative-faces-lost = Les faces avec des indices négatifs sont laissées de côté
    .explanation = -1 désigne le dernier sommet avant la ligne. Les faces qui utilisent des indices négatifs manquent ici.
    .fix = Si un indice est négatif, ajoutez-lui le nombre de sommets (ou de vt, ou de vn) déjà lus.
check-buffer-negative-from-the-end-of-the-file = Les indices négatifs comptent depuis la fin du fichier
    .explanation = -1 désigne le dernier sommet avant la ligne f, pas le dernier de tout le fichier. Ici, les faces sont résolues après la lecture complète, avec les longueurs finales des listes.
    .fix = Rendez un indice négatif positif en lisant sa ligne : ajoutez-lui le nombre de sommets lus jusque-là, plus 1.
check-buffer-negative-one-too-far = 1 est aussi soustrait aux indices négatifs
    .explanation = Soustrayez 1 aux indices positifs, qui comptent à partir de 1, mais pas aux négatifs, qui comptent depuis la fin. Ici, -1 désigne l'avant-dernier sommet.
    .fix = Soustrayez 1 seulement aux indices positifs.
check-buffer-normal-indices-from-0 = Seuls les indices des normales sont pris comme s'ils comptaient à partir de 0
    .explanation = Les positions sont justes, mais l'indice de la normale est utilisé sans soustraire 1 : chaque coin a la normale suivante.
    .fix = Soustrayez 1 aussi au troisième nombre d'un coin.
check-buffer-tex-coord-indices-from-0 = Seuls les indices des coordonnées de texture sont pris comme s'ils comptaient à partir de 0
    .explanation = Les positions sont justes, mais l'indice de la coordonnée de texture est utilisé sans soustraire 1 : chaque coin a la suivante.
    .fix = Soustrayez 1 aussi au deuxième nombre d'un coin.
check-buffer-position-indices-from-0 = Seuls les indices des positions sont pris comme s'ils comptaient à partir de 0
    .explanation = Les coordonnées de texture et les normales sont justes, mais l'indice de la position est utilisé sans soustraire 1.
    .fix = Soustrayez 1 aussi au premier nombre d'un coin.
check-buffer-u-and-v-swapped = u et v sont échangés
    .explanation = Une ligne vt contient u, puis v. Ici, ils sont échangés dans le tampon, et les textures sont couchées sur le côté.
    .fix = Écrivez d'abord le premier nombre de vt.
check-buffer-y-and-z-swapped = y et z sont échangés
    .explanation = Le tampon contient x, z, y : le modèle est couché sur le dos et inversé comme dans un miroir, et l'on voit son intérieur.
    .fix = Écrivez les nombres de v et de vn dans l'ordre du fichier. Pour tourner un modèle, utilisez la matrice du modèle.
check-buffer-turned-to-z-up = Le modèle est tourné : x, z, -y
    .explanation = Le modèle est tourné de 90 degrés autour de x, comme le font les programmes où z pointe vers le haut.
    .fix = Écrivez les nombres de v et de vn dans l'ordre du fichier. Pour tourner un modèle, utilisez la matrice du modèle.
check-buffer-winding-reversed = Les triangles tournent dans le sens opposé
    .explanation = Vus de l'avant, les coins d'une face tournent dans le sens antihoraire. Ici, deux coins de chaque triangle sont échangés : avec l'élimination des faces, l'avant n'est pas dessiné.
    .fix = Gardez l'ordre des coins : 1, i, i + 1.
check-buffer-faces-ignored = Les faces sont ignorées : v, vt et vn sont dans l'ordre du fichier
    .explanation = Les listes v, vt et vn sont associées par leur rang. Ce sont les lignes f qui définissent lesquels vont ensemble, et quels trois forment un triangle.
    .fix = Pour chaque coin de chaque ligne f, ajoutez la position, la coordonnée de texture et la normale qu'il désigne.
check-buffer-indices-not-applied = Chaque sommet distinct est une fois dans le tampon, sans ses indices
    .explanation = Ce sont les sommets pour glDrawElements, sans les indices qui les assemblent en triangles.
    .fix = Écrivez une ligne pour chaque coin de chaque triangle, ou rendez du JSON avec "vertices" et "indices".
check-buffer-one-normal-per-face = Tous les coins d'une face ont la normale du premier
    .explanation = Chaque coin désigne sa propre normale. Ici, celle du premier coin sert pour toute la face, et les modèles ronds paraissent à facettes.
    .fix = Utilisez le troisième nombre de chaque coin.
check-buffer-normals-computed = Les normales sont calculées à partir des triangles
    .explanation = Les normales sont celles des triangles plats, pas celles du fichier : les modèles ronds paraissent à facettes.
    .fix = Lisez les lignes vn. Ne calculez des normales que pour les fichiers qui n'en ont pas.
check-buffer-last-object-only = Seul le dernier objet est lu
    .explanation = Un fichier peut contenir plusieurs objets (lignes o). Seules les faces du dernier sont dans le tampon : chaque ligne o jette ce qui a été lu avant.
    .fix = Ne videz pas vos listes à une ligne o.
check-buffer-first-object-only = Seul le premier objet est lu
    .explanation = Un fichier peut contenir plusieurs objets (lignes o). Seules les faces du premier sont dans le tampon.
    .fix = Continuez la lecture après la deuxième ligne o.
check-buffer-indices-anew-in-each-object = Les indices recommencent à chaque objet
    .explanation = Les indices comptent dans tout le fichier, quels que soient ses objets. Ici, ils sont comptés depuis le premier sommet de chaque objet.
    .fix = Ne recommencez pas à compter à une ligne o.
check-buffer-first-lines-skipped = La première ligne de chaque sorte est sautée
    .explanation = Les premiers v, vt, vn et f manquent : tout est décalé de un, et une face est perdue.
    .fix = Vérifiez le début de votre boucle : elle lit peut-être une ligne trop tôt, ou saute le premier élément.
check-buffer-last-face-lost = La dernière face manque
    .explanation = Toutes les faces sauf la dernière sont dans le tampon : la boucle se termine un tour trop tôt, ou a besoin d'une fin de ligne après la dernière ligne.
    .fix = Traitez chaque ligne avant de tester s'il y en a une autre : while (std::getline(file, line)).
check-buffer-numbers-truncated = Les nombres perdent leur partie décimale
    .explanation = 0.625 devient 0. Les nombres sont lus comme des entiers (int, atoi), ou par une fonction qui attend une virgule décimale et s'arrête au point.
    .fix = Lisez des float, avec la locale C : setlocale(LC_NUMERIC, "C"), std::locale::classic().
check-buffer-decimal-comma = La lecture s'arrête au premier point décimal d'une ligne
    .explanation = Seule la partie entière du premier nombre de chaque ligne est lue, et le reste vaut 0 : le flux attend une virgule décimale, comme dans les locales française, néerlandaise et allemande, ou lit des entiers.
    .fix = Appelez file.imbue(std::locale::classic()) avant la lecture, et lisez des float.
check-buffer-empty-slot-passed-over = v//vn est lu comme v/vt
    .explanation = La deuxième case d'un coin v//vn est vide. Ici, les cases vides disparaissent quand le coin est découpé, et l'indice de la normale sert pour la coordonnée de texture.
    .fix = Découpez à chaque `/`, et gardez les parties vides.
check-buffer-short-corners-lost = Les faces dont les coins ne sont pas v/vt/vn sont laissées de côté
    .explanation = Un coin peut aussi être v, v/vt ou v//vn. Les faces avec de tels coins manquent : "%d/%d/%d" ne leur correspond pas.
    .fix = Découpez les coins à `/`, et vérifiez combien il y a de parties et lesquelles sont vides.

## buffers/buffer

check-buffer-the-columns-are-x-y-z = les colonnes sont ici x y z nx ny nz u v ; il faut x y z u v nx ny nz
check-buffer-the-numbers-are-64-bit-floats = les nombres sont des float de 64 bits ; il en faut de 32 bits (float, np.float32, Float32Array)
check-buffer-line = ligne { $line } : { $message }
check-buffer-line-column = ligne { $line }, colonne { $column } : { $message }

## buffers/compare

check-buffer-the-buffer-has-rows-which-is = le tampon a { $count } lignes, ce qui n'est pas un multiple de trois : trois lignes font un triangle
check-buffer-numbers-are-rounded-to-few-digits = les nombres sont arrondis à peu de chiffres : le tampon est juste, mais écrivez au moins six chiffres (std::setprecision, %.6f)
check-buffer-most-of-the-buffer-s-numbers = la plupart des nombres du tampon ne sont pas dans le fichier du modèle : est-ce le tampon d'un autre modèle ?

## buffers/formats

check-buffer-file-too-large = le fichier fait { $count } Mo ; au plus { $most } Mo sont lus
check-buffer-the-file-is-empty-was-it = le fichier est vide : a-t-il été fermé avant la fin du programme ?
check-buffer-raw-floats-take-4-bytes-each = les float bruts prennent 4 octets chacun, mais le fichier fait { $count } octets : a-t-il été ouvert en mode texte ("w" au lieu de "wb", sans std::ios::binary) ?
check-buffer-floats-not-of-stride = le fichier a { $floats } float, ce qui n'est pas un multiple des { $stride } que son nom indique
check-buffer-floats-not-whole-vertices = le fichier a { $floats } float, ce qui n'est pas un multiple de 3, 5, 6 ou 8 : ce ne sont pas des sommets entiers

## buffers/json

check-buffer-expected-a-list-of-rows-a = il faut une liste de lignes, une liste d'objets, {"{"}"positions", "tex_coords", "normals"{"}"} ou {"{"}"vertices", "indices"{"}"}
check-buffer-json-too-large = le fichier fait { $count } Mo ; au plus { $most } Mo de JSON sont lus : écrivez plutôt des float bruts
check-buffer-json-has-no-nan-write-null = {" "}(JSON n'a pas de NaN : écrivez null)
check-buffer-invalid-json = JSON non valide : { $message }{ $hint }
check-buffer-the-list-is-empty-no-vertex = la liste est vide : aucun sommet n'a été écrit
check-buffer-the-file-has-no-vertices = le fichier n'a pas de sommets
check-buffer-a-vertex-buffer = un tampon de sommets
check-buffer-the-list-has-numbers-which-is = la liste a { $count } nombres, ce qui n'est pas un multiple de 3, 5, 6 ou 8
check-buffer-row-is-not-a-list-of = la ligne { $number } n'est pas une liste de nombres ; { $shapes }
check-buffer-row-has-numbers-but-the-first = la ligne { $number } a { $count } nombres, mais la première en a { $first }
check-buffer-a-row-has-numbers-it-may = une ligne a { $count } nombres ; elle peut en avoir 3 (x y z), 5 (x y z u v), 6 (x y z nx ny nz) ou 8 (x y z u v nx ny nz)
check-buffer-vertex-is-not-an-object-but = le sommet { $number } n'est pas un objet, mais le premier en est un
check-buffer-vertex = sommet { $number } : { $message }
check-buffer-vertex-does-not-have-the-same = le sommet { $number } n'a pas les mêmes attributs que le premier
check-buffer-has-numbers-instead-of = `{ $key }` a { $found } nombres au lieu de { $count }
check-buffer-has-no-number = il manque le nombre `{ $name }`
check-buffer-is-unknown-and-was-ignored = `{ $key }` est inconnu et a été ignoré
check-buffer-vertices-is-one-list-of-numbers = "vertices" est une seule liste de nombres ; avec des indices, ce doit être une liste de lignes, [[x, y, z], ...]
check-buffer-texture-coordinates = coordonnées de texture
check-buffer-normals = normales
check-buffer-there-are-positions-and-each-vertex = il y a { $positions } positions et { $count } { $name } : chaque sommet du tampon a besoin d'une de chaque, associées comme les faces le définissent
check-buffer-has-numbers-which-is-not-a = `{ $key }` a { $count } nombres, ce qui n'est pas un multiple de { $width }
check-buffer-row-of-is-not-a-list = la ligne { $number } de `{ $key }` n'est pas une liste de { $width } nombres
check-buffer-is-not-a-list-of-numbers = `{ $key }` n'est pas une liste de nombres
check-buffer-indices-is-not-a-list-of = "indices" n'est pas une liste de nombres
check-buffer-index-is-expected-an-integer-from = l'indice { $number } vaut { $value } ; il faut un entier de 0 à 16777215
check-buffer-indices-count-from-0-here =  : les indices comptent ici à partir de 0
check-buffer-index-is-out-of-range-there = l'indice { $index } est hors limites : il y a { $count } sommets{ $hint }

## buffers/table

check-buffer-the-file-has-no-rows = le fichier n'a pas de lignes
check-buffer-the-file-has-a-header-but = le fichier a un en-tête mais pas de lignes
check-buffer-the-numbers-have-decimal-commas-write = les nombres ont des virgules décimales : écrivez des points décimaux, que tout programme lit
check-buffer-of-the-numbers-are-nan-or = { $count } des nombres sont NaN ou infinis
check-buffer-a-row-has-numbers-without-a = une ligne a { $width } nombres ; sans ligne d'en-tête, elle peut en avoir 3 (x y z), 5 (x y z u v), 6 (x y z nx ny nz) ou 8 (x y z u v nx ny nz)
check-buffer-the-file-is-utf-16-text = le fichier est un texte en UTF-16 (comme l'écrit `>` dans PowerShell) : enregistrez-le en UTF-8
check-buffer-the-file-is-binary-use-the = le fichier est binaire : utilisez l'extension `.raw` pour des float bruts
check-buffer-the-file-is-not-utf-8 = le fichier n'est pas un texte en UTF-8
check-buffer-a-number-is-missing-here = il manque un nombre ici
check-buffer-is-not-a-number = `{ $cell }` n'est pas un nombre
check-buffer-do-the-numbers-have-decimal-commas = {" "}(les nombres ont-ils des virgules décimales ? Écrivez des points décimaux.)
check-buffer-this-row-has-numbers-but-the = cette ligne a { $count } nombres, mais la première en a { $width }{ $comma }
check-buffer-the-column-is-named-twice = la colonne `{ $name }` est nommée deux fois
check-buffer-the-column-is-unknown-and-was = la colonne `{ $name }` est inconnue et a été ignorée
check-buffer-the-header-has-no-column-the = l'en-tête n'a pas de colonne { $name } : les noms sont x y z, u v, nx ny nz

## gl_program/check

check-gl-cannot-read-the-exercise-s-own = impossible de lire le programme de l'exercice : { $first }
check-gl-the-picture-is-right = l'image est juste
check-gl-the-picture-is-right-but = l'image est juste ; mais { $text }
check-gl-the-picture-is-right-and-there = l'image est juste, et il y a { $many } avertissements
check-gl-line-of-mistake = ligne { $line } : { $name }
check-gl-unexplained-with-rejected-call = l'image est fausse, et aucune erreur connue ne l'explique ; OpenGL a refusé un appel : { $error }
check-gl-unexplained = l'image est fausse, et aucune erreur connue ne l'explique

## gl_program/compare

check-gl-cannot-draw-the-exercise-s-own = impossible de dessiner le programme de l'exercice : { $error }

## gl_program/findings

check-gl-line-of-error = ligne { $line } : { $message }
check-gl-and-more = { $first }, et { $more } autres
check-gl-did-you-mean = vouliez-vous écrire `{ $known }` ?
check-gl-the-files-are = les fichiers sont { $files }
check-gl-unknown-file = fichier inconnu `{ $file }`
check-gl-and-do-not-link = l'édition des liens de `{ $vertex }` et `{ $fragment }` échoue : { $log }
check-gl-the-outputs-of-the-vertex-shader = les sorties du vertex shader et les entrées du fragment shader doivent avoir les mêmes noms et les mêmes types
check-gl-opengl-could-not-create-a-program = OpenGL n'a pas pu créer de programme à partir des shaders
check-gl-the-shader-does-not-compile = le shader n'est pas compilé : { $log }
check-gl-although-the-picture-is-right = { $message }, bien que l'image soit juste
check-gl-opengl-rejects-with = OpenGL refuse { $call } avec { $code } : { $why }
check-gl-depth-test-is-enabled-but-no = DEPTH_TEST est activé, mais aucun appel n'efface DEPTH_BUFFER_BIT : une deuxième image resterait vide
check-gl-the-program-has-no-uniform-and = le programme n'a pas d'uniform `{ $uniform }`, et OpenGL ne signale pas d'erreur
check-gl-clamp-to-border-mixes-the-border = CLAMP_TO_BORDER mélange la couleur de la bordure, noire, au bord de la texture

## gl_program/program

check-gl-the-text-has-bytes = le texte fait { $count } octets
check-gl-at-most-mb-are-read = au plus { $most } Mo sont lus
check-gl-the-file-is-not-text = le fichier n'est pas un texte
check-gl-hand-in-the-gl-program-as = rendez le programme GL sous forme de texte
check-gl-call-within-list = la liste `{ $name }`, qui commence à la ligne { $line }, n'a pas de fin avant cet appel
check-gl-there-are-more-than-calls = il y a plus de { $most } appels
check-gl-leave-some-out = supprimez-en
check-gl-list-without-end = la liste `{ $name }`, qui commence à la ligne { $line }, n'a pas de fin
check-gl-write-a-line-with-end-after = écrivez une ligne avec `end` après son dernier nombre
check-gl-the-program-has-no-calls = le programme n'a pas d'appels
check-gl-each-line-has-a-call-for = chaque ligne a un appel, par exemple `gen_texture`
check-gl-expects-one-name-and-the-numbers = `{ $text }` demande un nom, et les nombres sur les lignes suivantes
check-gl-for-example-corners = par exemple `{ $text } corners`
check-gl-cannot-be-a-name = `{ $text }` ne peut pas être un nom
check-gl-choose-a-name-that-is-not = choisissez un nom qui n'est pas un appel
check-gl-already-exists = `{ $text }` existe déjà
check-gl-choose-another-name = choisissez un autre nom
check-gl-write-integers-from-0 = écrivez des entiers à partir de 0
check-gl-is-not-an-index = `{ $text }` n'est pas un indice
check-gl-write-numbers-such-as-0-5 = écrivez des nombres tels que 0.5, et `end` après le dernier
check-gl-is-not-a-number = `{ $text }` n'est pas un nombre
check-gl-the-list-has-more-than-numbers = la liste `{ $name }` a plus de { $most } nombres
check-gl-make-it-shorter-a-buffer-may = raccourcissez-la : un tampon peut faire au plus 1 Mo

## gl_program/signature

check-gl-a-list-of-numbers = une liste de nombres
check-gl-an-image = une image
check-gl-a-number = un nombre
check-gl-expected-spaces-around = il faut des espaces autour de `=`
check-gl-write-name-call = écrivez `nom = appel`
check-gl-expected-a-call-after = il faut un appel après `=`
check-gl-write-name-gen-texture-or-the = écrivez `nom = gen_texture` ou un autre appel
check-gl-expects-argument-but-got = `{ $text }` demande { NUMBER($count) ->
        [one] { $count } argument
       *[other] { $count } arguments
    }, mais en a { $given }
check-gl-write = écrivez `{ $text }`
check-gl-write-plain = écrivez { $text }
check-gl-is-a-constant-of-opengl = `{ $text }` est une constante d'OpenGL
check-gl-is-already = `{ $text }` est déjà { $words }
check-gl-take-another-name = prenez un autre nom
check-gl-write-name = écrivez `nom = { $text }`
check-gl-the-result-of-is-not-stored = le résultat de `{ $text }` n'est pas gardé
check-gl-returns-nothing-that-can-be-stored = `{ $text }` ne renvoie rien qui puisse être gardé dans `{ $text2 }`
check-gl-write-without-a-name = écrivez `{ $text }` sans nom
check-gl-unknown-word = appel inconnu `{ $word }`
check-gl-an-argument-is-missing = il manque un argument
check-gl-write-the-name-that-it-has = écrivez le nom qu'il a dans le shader ; gonio cherche son emplacement
check-gl-cannot-be-the-name-of-a = `{ $text }` ne peut pas être le nom d'une variable de shader
check-gl-is-too-large = `{ $text }` est trop grand
check-gl-is-not-an-integer = `{ $text }` n'est pas un entier
check-gl-write-an-integer-such-as-32 = écrivez un entier tel que 32
check-gl-write-a-number-such-as-0 = écrivez un nombre tel que 0.5
check-gl-is-neither-true-nor-false = `{ $other }` n'est ni TRUE ni FALSE
check-gl-write-false = écrivez FALSE
check-gl-named-is-not-a-number = `{ $text }` est { $words }, pas un nombre
check-gl-use-a-name-that-stores-the = utilisez un nom qui garde le résultat d'un appel
check-gl-a-line-must-come-before-this = une ligne `{ $text } = ...` doit précéder celle-ci
check-gl-named-is-of-another-kind = `{ $text }` est { $words }, pas { $words2 }
check-gl-create-one-with = créez-en un avec `{ $how }`
check-gl-create-it-first-with = créez-le d'abord, avec `{ $how }`
check-gl-is-not-defined-yet = `{ $text }` n'est pas encore défini
check-gl-write-without-gl-commas-and-parentheses = écrivez `{ $bare }`, sans GL_, sans virgules ni parenthèses
check-gl-write-constants-in-upper-case-without = écrivez les constantes en majuscules, sans GL_
check-gl-unknown-constant = constante inconnue `{ $text }`
check-gl-write-with-its-arguments-without-parentheses = écrivez `{ $known }`, avec ses arguments sans parenthèses ni virgules
check-gl-write-calls-without-gl-in-lower = écrivez les appels sans `gl`, en minuscules, avec `_` entre les mots
check-gl-text-md-has-a-table-of = text.md a un tableau des appels
check-gl-unknown-call = appel inconnu `{ $text }`

## gl_program/suspects/picture

check-gl-the-index-buffer-contains-unsigned-int = le tampon d'indices contient des UNSIGNED_INT, mais il est lu comme { $name }
check-gl-write-unsigned-int = écrivez UNSIGNED_INT
check-gl-the-draw-begins-at-byte-of = le dessin commence à l'octet { $offset } du tampon d'indices
check-gl-write-0 = écrivez 0
check-gl-the-indices-in-start-at-1 = les indices de `{ $name }` commencent à 1, mais le premier coin est 0
check-gl-subtract-1-from-each = soustrayez 1 à chacun
check-gl-contains-other-corners-than-0-1 = `{ $name }` contient d'autres coins que 0, 1 et 2
check-gl-write-0-1-2 = écrivez 0 1 2
check-gl-no-element-array-buffer-or-another = aucun ELEMENT_ARRAY_BUFFER, ou un autre, n'est lié dans le vertex array dessiné
check-gl-write-bind-buffer-element-array-buffer = écrivez `bind_buffer ELEMENT_ARRAY_BUFFER { $buffer }` après bind_vertex_array
check-gl-is-created-but-never-used = `{ $name }` est créé mais jamais utilisé
check-gl-write-use-program-before-the-uniforms = écrivez `use_program { $name }` avant les uniforms et le dessin
check-gl-0-unbinds-the-program-and-the = 0 abandonne le programme, et le dessin qui suit n'en a pas
check-gl-this-is-not-the-number-of = ce n'est pas le numéro de `{ $name }`
check-gl-write-use-program = écrivez `use_program { $name }`
check-gl-the-picture-is-drawn-into-x = l'image est dessinée dans { $width } x { $height } pixels en ({ $x }, { $y })
check-gl-set-it-to-0-0-and = donnez-lui 0 0 puis la largeur et la hauteur de l'image, ou supprimez-le
check-gl-this-clears-what-line-has-drawn = ceci efface ce que la ligne { $line } a dessiné
check-gl-write-it-before-the-draw = écrivez-le avant le dessin
check-gl-the-picture-keeps-its-previous-content = l'image garde son contenu précédent
check-gl-write-clear-color-buffer-bit-before = écrivez `clear COLOR_BUFFER_BIT` avant lui
check-gl-write-clear-color = écrivez `clear_color { $r } { $g } { $b } { $a }`
check-gl-no-clear-color-comes-before-this = aucun clear_color ne précède cet appel : le fond est noir
check-gl-clear-in-line-uses-the-colour = clear, à la ligne { $line }, utilise la couleur choisie avant lui
check-gl-write-it-before-clear = écrivez-le avant clear
check-gl-the-background-is-not-the-exercise = le fond n'est pas le gris-bleu foncé de l'exercice
check-gl-the-triangle-s-corners-are-clockwise = les coins du triangle tournent dans le sens horaire, et CULL_FACE élimine de tels triangles
check-gl-remove-it = supprimez-le
check-gl-write-draw-arrays-at-the-end = écrivez `draw_arrays { $name } { $first } { $count }` à la fin
check-gl-no-call-draws-anything = aucun appel ne dessine
check-gl-vertices-are-drawn-but-there-are = { $many } sommets sont dessinés, mais il y en a { $count }
check-gl-the-draw-begins-at-vertex = le dessin commence au sommet { $from }
check-gl-indices-are-drawn-but-there-are = { $many } indices sont dessinés, mais il y en a { $count }
check-gl-joins-the-corners-in-another-way = { $name } relie les coins autrement que { $name2 }
check-gl-the-calls-that-follow-are-meant = les appels qui suivent sont destinés au dessin, mais viennent après lui
check-gl-write-it-at-the-end = écrivez-le à la fin

## gl_program/suspects/textures

check-gl-the-draw-in-line-has-already = le dessin à la ligne { $draw } a déjà lu `{ $uniform }`
check-gl-is-set-to-the-name-of = `{ $uniform }` reçoit `{ $name }`, le nom d'une texture, qui est liée à l'unité { $unit }
check-gl-write-uniform-1i = écrivez `uniform_1i { $uniform } { $unit }`
check-gl-is-a-sampler-and-a-sampler = `{ $uniform }` est un échantillonneur, et un échantillonneur est un entier
check-gl-reads-unit-but-the-texture-is = `{ $uniform }` lit l'unité { $value }, mais la texture est liée à l'unité { $unit }
check-gl-write-uniform-1i-or-bind-the = écrivez `uniform_1i { $uniform } { $unit }`, ou liez la texture à l'unité { $value }
check-gl-the-program-has-no-uniform-its = le programme n'a pas d'uniform `{ $uniform }` ; son échantillonneur est `{ $sampler }`
check-gl-no-program-is-in-use-here = aucun programme n'est utilisé ici : use_program vient à la ligne { $line }, et `{ $uniform }` reste à 0
check-gl-write-it-after-use-program-in = écrivez-le après use_program, à la ligne { $line }
check-gl-is-made-active-only-after-the = { $name } n'est activée qu'après la liaison de la texture, à la ligne { $bind }
check-gl-write-it-before-bind-texture-in = écrivez-le avant bind_texture, à la ligne { $bind }
check-gl-a-plain-number-is-not-a = un simple nombre n'est pas une unité, et OpenGL le refuse : écrivez une unité telle que { $name }
check-gl-is-never-set-and-reads-unit = `{ $sampler }` ne reçoit jamais de valeur et lit l'unité 0, mais la texture est liée à l'unité { $unit }
check-gl-write-uniform-1i-after-use-program = écrivez `uniform_1i { $sampler } { $unit }` après use_program
check-gl-texture-is-deleted = la texture est supprimée avant le dessin de la ligne { $line }
check-gl-buffer-is-deleted = le tampon est supprimé avant le dessin de la ligne { $line }
check-gl-vertex-array-is-deleted = le vertex array est supprimé avant le dessin de la ligne { $line }
check-gl-delete-it-after-the-draw = supprimez l'objet après le dessin
check-gl-is-the-target-of-another-kind = { $written } est la cible d'un autre genre de texture : le sampler2D lit TEXTURE_2D
check-gl-write-texture-2d-in-this-line = écrivez TEXTURE_2D dans cette ligne et dans toutes les autres pour cette texture
check-gl-write-texture-2d = écrivez TEXTURE_2D
check-gl-write-bind-texture-texture-2d-before = écrivez `bind_texture TEXTURE_2D { $name }` avant les autres appels pour la texture
check-gl-the-texture-is-never-bound = la texture `{ $name }` n'est jamais liée
check-gl-the-call-in-line-is-meant = l'appel à la ligne { $first } est destiné à cette texture, mais précède sa liaison
check-gl-write-it-before-line = écrivez-le avant la ligne { $line }
check-gl-0-unbinds-the-texture-so-the = 0 délie la texture, et le dessin lit une unité vide
check-gl-this-texture-replaces-the-one-to = cette texture remplace celle à dessiner, car la même unité est active
check-gl-call-active-texture-with-another-unit = appelez avant elle active_texture avec une autre unité
check-gl-should-be-drawn-but-something-else = `{ $name }` devrait être dessiné, mais autre chose est lié ici
check-gl-write-bind-texture = écrivez `bind_texture { $name } { $name2 }`
check-gl-with-this-levels-are-read-that = avec ce { $name }, des niveaux qui n'existent pas sont lus
check-gl-opengl-rejects-for-texture-mag-filter = OpenGL refuse { $name } pour TEXTURE_MAG_FILTER, et TEXTURE_MIN_FILTER reste inchangé
check-gl-write-texture-min-filter = écrivez TEXTURE_MIN_FILTER
check-gl-opengl-rejects-and-texture-min-filter = OpenGL refuse { $name }, et TEXTURE_MIN_FILTER reste inchangé
check-gl-write-linear = écrivez LINEAR
check-gl-the-filter-set-in-line-needs = le filtre choisi à la ligne { $line } a besoin de mipmaps, mais cette image n'en a pas
check-gl-write-generate-mipmap-texture-2d-after = écrivez `generate_mipmap TEXTURE_2D` après elle, ou utilisez le filtre LINEAR
check-gl-texture-min-filter-is-never-set = TEXTURE_MIN_FILTER n'est jamais choisi ; sa valeur par défaut a besoin de mipmaps, et cette image n'en a pas
check-gl-write-tex-parameter-texture-2d-texture = écrivez `tex_parameter TEXTURE_2D TEXTURE_MIN_FILTER LINEAR`, ou `generate_mipmap TEXTURE_2D` après elle
check-gl-the-image-comes-only-in-line = l'image ne vient qu'à la ligne { $image }
check-gl-write-it-after-line = écrivez-le après la ligne { $image }
check-gl-the-texture-bound-here-is-not = la texture liée ici n'est pas celle qui a reçu son image à la ligne { $image }
check-gl-write-it-right-after-line = écrivez-le juste après la ligne { $image }
check-gl-the-format-does-not-keep-the = le format { $name } ne garde pas les couleurs de l'image
check-gl-write-rgb8 = écrivez RGB8
check-gl-the-image-is-passed-to-level = l'image est donnée au niveau { $level }, et le niveau 0 reste vide
check-gl-write-level-0 = écrivez le niveau 0
check-gl-is-loaded-but-the-exercise-s = `{ $file }` est chargé, mais l'image de l'exercice est `{ $right }`
check-gl-write-tex-image-2d-texture-2d = écrivez `tex_image_2d TEXTURE_2D 0 RGB8 { $image }` après lui
check-gl-this-texture-never-gets-an-image = cette texture ne reçoit jamais d'image

## gl_program/suspects/vertices

check-gl-write-bind-vertex-array-after-it = écrivez `bind_vertex_array { $name }` après lui
check-gl-is-created-but-never-bound = `{ $name }` est créé mais jamais lié
check-gl-write-array-gen-vertex-array-and = écrivez `array = gen_vertex_array` et `bind_vertex_array array` avant lui
check-gl-no-vertex-array-is-bound-to = aucun vertex array n'est lié pour enregistrer ce réglage
check-gl-line-is-meant-for-this-vertex = la ligne { $line } est destinée à ce vertex array, mais précède sa liaison
check-gl-0-unbinds-the-vertex-array-before = 0 délie le vertex array avant le dessin de la ligne { $draw }
check-gl-bind-the-vertex-array-again-before = liez de nouveau le vertex array avant le dessin, ou supprimez cet appel
check-gl-the-attributes-were-described-in-but = les attributs ont été décrits dans `{ $name }`, mais un autre vertex array est lié au moment du dessin
check-gl-write-bind-vertex-array = écrivez `bind_vertex_array { $name }`
check-gl-0-unbinds-the-vertex-array-but = 0 délie le vertex array, mais les appels qui suivent lui sont destinés
check-gl-write-bind-buffer-array-buffer-after = écrivez `bind_buffer ARRAY_BUFFER { $buffer }` après lui
check-gl-is-created-but-never-bound-to = `{ $buffer }` est créé mais jamais lié à ARRAY_BUFFER
check-gl-line-is-meant-for-this-buffer = la ligne { $line } est destinée à ce tampon, mais précède sa liaison
check-gl-0-unbinds-the-buffer-from-so = 0 délie le tampon de { $name }, et les appels qui suivent n'en ont pas
check-gl-this-buffer-is-not-read-from = ce tampon n'est pas lu depuis { $name }
check-gl-write-buffer-data-array-buffer-static = écrivez `buffer_data ARRAY_BUFFER { $data } STATIC_DRAW` après lui
check-gl-this-buffer-never-gets-any-bytes = ce tampon ne reçoit jamais d'octets
check-gl-stride = un pas (stride) de { $stride }
check-gl-offset = un décalage (offset) de { $offset }
check-gl-size = une taille de { $size }
check-gl-has-but-the-data-needs = `{ $attribute }` a { $was }, mais les données demandent { $is }
check-gl-described-here-but-never-enabled = { $names } : décrits ici, mais jamais activés
check-gl-write-enable-vertex-attrib-array-after = écrivez `enable_vertex_attrib_array { $name }` après lui
check-gl-is-disabled-before-the-draw-in = `{ $attribute }` est désactivé avant le dessin de la ligne { $draw }
check-gl-write-vertex-attrib-pointer-float-false = écrivez `vertex_attrib_pointer { $name } { $size } FLOAT FALSE { $stride } { $offset }`
check-gl-no-vertex-attrib-pointer-says-where = aucun vertex_attrib_pointer ne dit où est `{ $name }`
check-gl-the-program-has-no-attribute-and = le programme n'a pas d'attribut `{ $wrong }`, et `{ $meant }` ne reçoit pas de données
check-gl-is-used-here-but-is-never = `{ $name }` est utilisé ici, mais `{ $meant }` n'est jamais décrit
check-gl-the-buffer-is-filled-with-but = le tampon est rempli avec `{ $data }`, mais les coins sont dans `{ $other }`
check-gl-does-not-contain-the-exercise-s = `{ $name }` ne contient pas les nombres de l'exercice
check-gl-restore-the-original-numbers = remettez les nombres d'origine

## baking/answer

check-baking-the-picture-has-x-texels-at = l'image a { $width } x { $height } texels ; au plus { $most } x { $most } sont vérifiés, précalculez-en une plus petite
check-baking-the-pictures-of-this-folder-are = les images de ce dossier sont trop grandes ensemble ; rendez seulement celle du précalcul

## baking/findings

check-baking-has-triangles = { $name } a { $triangles } triangles
check-baking-triangles-of-are-not-in-the = { $extra } triangles de { $name } ne sont pas dans le modèle d'origine
check-baking-the-model-is-times-as-large = le modèle est { $scale } fois aussi grand que l'original
check-baking-the-model-is-in-another-place = le modèle n'est pas au même endroit que l'original
check-baking-their-area-is-times-that-of = leur aire vaut { $area } fois celle de l'image
check-baking-of-the-texels = { $conflicts } % des texels, { $both }
check-baking-charts-overlap-but-only-where-they = des îlots se recouvrent, mais seulement là où ils ont la même couleur
check-baking-of-them = { $outside } % d'entre elles
check-baking-some-texture-coordinates-are-outside-of = des coordonnées de texture sont hors de 0 à 1 ; l'image y est juste parce qu'elle se répète
check-baking-of-a-lookup-at-a-border = { $share } % d'une lecture au bord
check-baking-x-texels-of-the-surface-has = { $width } x { $height } texels, { $share } % de la surface a une autre couleur
check-baking-x-texels-are-few-details-are = { $width } x { $height } texels, c'est peu : des détails sont perdus ; 1024 x 1024 les garde
check-baking-is-transparent-on-the-surface-programs = { $name } est transparent sur la surface : les programmes qui utilisent son alpha montrent des trous ; enregistrez l'image en RGB

## baking/materials

check-baking-instead-of = { $path } au lieu de { $chosen }
check-baking-and-the-file-s-name-differ = { $path } et le nom du fichier diffèrent par les majuscules : Linux ne le trouve pas
check-baking-material-has-a-factor-of-beside = le matériau { $name } a un facteur de { $factor } en plus de sa texture : les programmes qui les multiplient le montrent plus sombre ; écrivez Kd 1 1 1

## baking/original

check-baking-only-built-in-files-can-be = seuls les fichiers intégrés peuvent être lus ici
check-baking-the-exercise-s-file-was-not = le fichier { $path } de l'exercice n'a pas été téléchargé
check-baking-the-exercise-has-no-model-to = l'exercice n'a pas de modèle à précalculer

## baking/verdict

check-baking-no-model-handed-in = il n'y a pas de modèle parmi les fichiers : rendez le .obj avec son .mtl et l'image précalculée, ou un .glb
check-baking-there-are-models-among-the-files = il y a { $count } modèles parmi les fichiers ; vérifiez-en un à la fois
check-baking-no-model = il n'y a pas de modèle parmi les fichiers
check-baking-the-picture-of-is-right-everywhere = l'image de { $name } est juste partout sur le modèle
check-baking-the-colours-of-one-part = les couleurs d'une partie
check-baking-not-read = non lu : { $reason }
check-baking-of-the-surface-has-the-right = { $percent } % de la surface a la bonne couleur ; aucune erreur connue n'explique le reste ({ $parts })

## cubemap

check-cubemap-there-are-pictures-among-the-files = il y a { $count } images parmi les fichiers ; rendez six faces
check-cubemap-hand-in-the-six-faces-as = { $name } : rendez les six faces en PNG ou en JPEG
check-cubemap-there-are-no-faces-among-the = il n'y a pas de faces parmi les fichiers : rendez six images, de posx.png à negz.png
check-cubemap-the-faces-must-be-square-and = les faces doivent être carrées et de même taille ; l'une a { $width } x { $height } pixels, une autre { $width2 } x { $height2 }
check-cubemap-the-faces-have-x-pixels-at = les faces ont { $size } x { $size } pixels ; il en faut au moins { $least } x { $least }
check-cubemap-the-faces-have-x-pixels-much = les faces ont { $size } x { $size } pixels : beaucoup de détails du panorama sont perdus ; { $natural } x { $natural } les garderait
check-cubemap-the-exercise-has-no-panorama-hand = l'exercice n'a pas de panorama ; rendez le vôtre avec les faces
check-cubemap-is-not-a-panorama = { $name } n'est pas un panorama
check-cubemap-has-x-pixels-which-is-neither = { $name } a { $width } x { $height } pixels, ce qui n'est ni une croix ni une bande de six faces ; rendez posx.png à negz.png
check-cubemap-was-read-as-a = { $name } a été lu comme suit : { $arrangement }

## preview/files

check-preview-none-of-these-files-is-an = aucun de ces fichiers n'est une réponse : { $id } lit { $kind }
check-preview-and-more = {" "}et { $more } autres
check-preview-ignored-reads = ignoré : { $names }{ $more } ; { $id } lit { $reads }
check-preview-a-scene = une scène
check-preview-a-model = un modèle
check-preview-is-leave-the-exercises-with-the = { $name } est { $what } : quittez les exercices par la flèche en haut à gauche, et ouvrez le fichier là
check-preview-there-is-no-shader-in-reads = il n'y a pas de shader dans { $name } : { $id } lit { $reads }
check-preview-does-not-read-it-reads = { $id } ne lit pas { $name } : il lit { $reads }
check-preview-reads-shaders = un vertex shader et un fragment shader, dans des fichiers de noms quelconques ou dans les chaînes d'un programme, et names.toml
check-preview-reads-shaders-or-faces = un vertex shader et un fragment shader, ou six faces sous forme d'images
check-preview-a-vertex-buffer-csv-tsv-json = un tampon de sommets (.csv, .tsv, .json, ou des float bruts en .bin, .raw ou .f32)
check-preview-gl-programs-txt = des programmes GL (.txt)
check-preview-a-model-with-its-materials-and = un modèle avec ses matériaux et son image (.obj, .mtl et .png, ou .glb)

## preview/mod

check-preview-the-exercise-about-skyboxes-is-missing = l'exercice sur les skyboxes manque

## preview/pair

check-preview-names-toml-mentions-which-the-shaders = names.toml mentionne `{ $name }`, que les shaders n'utilisent pas

## preview/renderer

check-preview-the-exercise-s-sky = le ciel de l'exercice
check-preview-from-the-mesh = du maillage
check-preview-0-0-0-1-not-in = 0 0 0 1 : pas dans le maillage
check-preview-a-value = une valeur
check-preview-unit-0-gonio-s-sky = unité 0 : le ciel de gonio
check-preview-unit-1-white = unité 1 : blanc

## preview/scene

check-preview-lab-pyramid = celle du TP : une pyramide à l'origine
check-preview-the-pyramid-turned-and-moved-within = la pyramide tournée et déplacée dans un globe de nombreuses couleurs, vue par une caméra elle aussi tournée
check-preview-lab-lamp = celle du TP : une sphère à la moitié de sa taille, et une lampe qui se balance
check-preview-lab-spheres = celle du TP : une sphère de peu de triangles, une de plus, une de beaucoup
check-preview-a-ring-that-is-stretched-turned = un anneau étiré, tourné et déplacé : il révèle les normales multipliées par M, et les matrices dans le mauvais ordre
check-preview-a-ring-stretched-and-turned-its = un anneau, étiré et tourné : ses normales ne ressemblent pas à ses positions
check-preview-a-smooth-sphere-under-the-lab = une sphère lisse sous le ciel du TP
check-preview-the-sky-seen-by-a-camera = le ciel, vu par une caméra loin de l'origine : un ciel qui se rapproche est faux

## step/endless

check-step-this-loop-never-ends = cette boucle ne se termine jamais
check-step-the-loop-in-line-of-never = la boucle à la ligne { $line } de { $file } ne se termine jamais

## step/pair

check-step-gonio-cannot-run-on-the-cpu = gonio ne peut pas exécuter { $construct } sur le CPU
check-step-rewrite-this-part-without-it-to = réécrivez cette partie sans cela pour parcourir le shader pas à pas

## step/picture

check-step-black-is-and-white-is = le noir vaut { $least } et le blanc { $greatest }
check-step-black-is-false-and-white-is = le noir vaut false et le blanc true
check-step-colour = rouge, vert et bleu sont ses composantes, de 0 à 1
check-step-direction = rouge, vert et bleu sont (x + 1) / 2 de ses composantes, de -1 à 1
check-step-range = rouge, vert et bleu sont ses composantes, de { $least } à { $greatest }
check-step-there-is-no-expression-point-at = { $file }:{ $line }:{ $column }: il n'y a pas d'expression ; pointez un nom ou un opérateur
check-step-the-shader-does-not-end =  ; le shader ne se termine pas
check-step-choose-another-expression =  ; choisissez une autre expression
check-step-no-pixel-evaluates = { $file }:{ $line }:{ $column }: aucun pixel n'évalue `{ $text }`{ $why }
check-step-has-the-type-choose-a-number = { $file }:{ $line }:{ $column }: `{ $text }` est de type { $written } ; choisissez un nombre ou un vecteur, par exemple un de ses membres ou une colonne

## step/user_picture

check-step-the-shader-does-not-end-here = { $file }:{ $line }: le shader ne se termine pas ici dans le temps que le CPU lui accorde ; raccourcissez ses boucles

## step/value

check-step-and-more = , et { $left } autres

## check

check-there-is-no-buffer-among-the = il n'y a pas de tampon parmi les fichiers : rendez un .csv, un .json ou un .bin comme le décrit text.md
check-there-are-buffers-among-the-files = il y a { $count } tampons parmi les fichiers ; vérifiez-en un à la fois
check-the-buffer-resembles-none-of-the = le tampon ne ressemble à aucun des modèles de l'exercice ; donnez au fichier le nom de son modèle, par exemple cube.csv
check-all-triangles-of-are-right = les { $count } triangles de { $model } sont tous justes
check-mistakes-of-model = { $names } (pour { $model })
check-of-the-triangles-of-are-right = { $percent } % des triangles de { $model } sont justes ; aucune erreur connue n'explique les autres
check-there-is-no-gl-program-among = il n'y a pas de programme GL parmi les fichiers : rendez un .txt comme le décrit text.md
check-there-are-gl-programs-among-the = il y a { $count } programmes GL parmi les fichiers ; vérifiez-en un à la fois

## class

check-a-system-file-not-a-student = un fichier du système, pas d'un étudiant
check-it-is-beside-the-submissions-not = est à côté des rendus, pas dans l'un d'eux
check-it-contains-no-answer = ne contient pas de réponse
check-an-earlier-attempt-of-the-same = une tentative précédente du même étudiant


## Names of test scenes and terms, by their ids in verdicts

check-scene-name-lab = TP
check-scene-name-stretched = étiré
check-scene-name-coarse = grossière
check-scene-name-behind = derrière
check-scene-name-near = près
check-scene-name-middle = entre-deux
check-scene-name-far = loin
check-scene-name-turned = tournée
check-scene-name-coloured = coloré
check-scene-name-two-lights = deux lumières
check-scene-name-second-light = seconde lumière
check-scene-name-front = de face
check-scene-name-ahead = devant
check-scene-name-right = à droite
check-scene-name-moved = déplacée
check-scene-name-up = vers le haut
check-scene-name-above = d'en haut
check-scene-name-tilted = penchée
check-scene-name-off-centre = décentrée
check-scene-name-to-the-right = vers la droite
check-scene-name-close = de près
check-scene-name-face = face
check-scene-alone = { $scene }, terme { $term } seul
check-term-ambient = ambiant
check-term-diffuse = diffus
check-term-specular = spéculaire

## Les exercices d'un cours
check-differs-from-the-reference-in = l'image diffère de celle de la référence dans : { $scenes }
check-input-of-the-reference-not-read = la référence lit { $names } ; ce programme ne lit rien qui ait ce sens
check-reference-does-not-compile = la référence de l'exercice n'est pas compilée par ce pilote : { $error }
check-scene-of-course = une scène propre à cet exercice
check-stored-pictures-damaged = les images enregistrées de la référence sont abîmées ; refaites le paquet de l'exercice
check-stored-pictures-other-scenes = les images enregistrées de la référence montrent d'autres scènes de test, d'une autre version de gonio ou d'avant une modification de l'exercice ; refaites le paquet de l'exercice
check-points = { $earned } points sur { $most }
