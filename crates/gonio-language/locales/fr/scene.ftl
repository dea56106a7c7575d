# scene

## panels/camera

scene-place = Placement
scene-camera-position-in-world-space = Position de la caméra dans l'espace du monde
scene-position = Position
scene-the-point-that-the-camera-looks = Le point que regarde la caméra, dans l'espace du monde
scene-target = Cible
scene-yaw = Lacet
scene-yaw-of-the-viewing-direction-90 = Lacet de la direction de visée ; -90° regarde le long de -Z
scene-pitch = Tangage
scene-pitch-positive-looks-up = Tangage ; positif, il regarde vers le haut
scene-worldup-the-up-direction-made-perpendicular = WorldUp : la direction du haut, rendue perpendiculaire à la direction de visée
scene-up = Haut
scene-lens = Objectif
scene-field-of-view-2 = Champ
scene-full-vertical-angle = Angle vertical complet
scene-full-vertical-field-of-view-the = Champ de vision vertical complet ; les 45 rad du TP font 58,3°
scene-field-of-view = champ de vision
scene-near = Proche
scene-distance-of-the-near-plane-in = Distance du plan proche, en unités du monde
scene-far = Lointain
scene-distance-of-the-far-plane-in = Distance du plan lointain, en unités du monde
scene-1-for-points = 1, pour les points
scene-1-w-becomes-the-depth-by = −1 : w devient la profondeur, par laquelle x, y et z sont divisés
scene-view-matrix-v = Matrice de vue V
scene-from-world-to-eye-space-the = De l'espace du monde à celui de la caméra : les axes de la caméra en lignes et, dans la dernière colonne, l'opposé de la position dans ces axes
scene-projection-matrix-p = Matrice de projection P
scene-from-eye-to-opengl-s-clip = De l'espace de la caméra à l'espace de découpage (clip) d'OpenGL : z va de -1 (proche) à 1 (lointain)

## panels/compare/measured

scene-nothing-has-been-drawn-yet = Rien n'a encore été dessiné
scene-vertex-shader-runs-where-gouraud-shading = Exécutions du vertex shader, où l'ombrage de Gouraud évalue l'équation ; exécutions du fragment shader (y compris les fragments auxiliaires des blocs de 2 x 2), où l'évaluent les autres ombrages ; et durée de la dernière trame terminée
scene-the-panes-have-not-been-compared = Les vues n'ont pas encore été comparées
scene-pixels = { $count } pixels, { $percent } %
scene-differing = Différents
scene-by-more-than-1-255-in = De plus de 1/255 dans au moins un canal
scene-largest = Maximum
scene-8-bit-steps = En niveaux sur 8 bits
scene-mean = Moyenne
scene-of-the-absolute-differences-8-bit = Des différences absolues, en niveaux sur 8 bits
scene-root-of-the-mean-square = Racine de la moyenne des carrés, en niveaux sur 8 bits
scene-db = { $db } dB
scene-20-log10-255-rms = 20 log10(255 / RMS)
scene-maximum-at = Maximum en
scene-column-and-row-of-the-pixel = Colonne et ligne du pixel, entouré sur la carte
scene-a-part-of-it-is-noise = Une partie est du bruit, qui s'estompe ({ $traced })
scene-stop = Arrêter
scene-draw-the-curve = Tracer la courbe
scene-draw-it-again = La retracer
scene-draws-the-scene-with-more-and = Dessine la scène avec de plus en plus de triangles en ombrage plat, de Gouraud et de Phong, et compare chaque image à la plus fine
scene-of = { $done } sur { $all }
scene-rms-difference-0-to-255 = Différence RMS (0 à 255)
scene-error-curve = courbe d'erreur
scene-against = par rapport à { $against }
scene-per-face = par face

## panels/compare/mod

scene-pane = Vue { $current }
scene-measured = Mesures
scene-one-sample-per-pixel-while-something = Un échantillon par pixel pendant les mouvements, si les trames sont lentes
scene-one-sample-while-moving = Un échantillon pendant les mouvements
scene-error-against-the-finest-mesh = Erreur par rapport au maillage le plus fin
scene-panes = Vues
scene-remove-pane = Supprimer la vue { $index }
scene-add-a-copy-of-this-pane = Dupliquer cette vue
scene-apply-to-all-panes = Appliquer à toutes
scene-copies-the-settings-of-the-current = Copie les réglages de la vue courante dans les autres vues
scene-arrangement = Disposition
scene-side-by-side = Côte à côte
scene-all-panes-next-to-each-other = Toutes les vues les unes à côté des autres
scene-wipe = Volet
scene-two-panes-on-top-of-each = Deux vues superposées, avec une séparation à faire glisser
scene-difference = Différence
scene-colour-map-of-the-difference-between = Carte en couleurs de la différence entre deux vues
scene-the-difference-in-8-bit-steps = La différence, en niveaux sur 8 bits, qui reçoit la couleur la plus claire
scene-full-scale = Pleine échelle
scene-signed-second-minus-first = Signée : seconde moins première
scene-signed = Signée

## panels/compare/plot

scene-triangles-of-255 = { $name } : { $triangles } triangles, { $difference } sur 255

## panels/compare/settings

scene-as-in-the-scene = comme dans la scène
scene-shading = Ombrage
scene-specular-term = Spéculaire
scene-convention = Convention
scene-spec-times-n-l = spec fois <N.L>
scene-view = Contenu
scene-reset-to-the-scene = Revenir à la scène
scene-triangles = Triangles
scene-double-click-as-in-the-scene = Double-clic : comme dans la scène
scene-triangles-of-each-sphere-8-f = Triangles de chaque sphère : 8 f², à partir des faces d'un octaèdre
scene-triangles-of-the-sphere = Triangles de la sphère
scene-share-of-each-model-s-triangles = Part conservée des triangles de chaque modèle
scene-share-of-the-triangles = Part des triangles
scene-one = Une seule
scene-one-pane-with-the-scene-s = Une vue avec les réglages de la scène
scene-flat-gouraud-phong = Plat | Gouraud | Phong
scene-where-the-equation-is-evaluated = Où l'équation est évaluée
scene-r-v-or-n-h-to = ⟨R·V⟩ ou ⟨N·H⟩ à la puissance g, la brillance
scene-lab-physical = TP | physique
scene-without-and-with-1-and-the = Sans et avec 1/π et le cosinus du terme spéculaire
scene-traced-opengl = Tracé | OpenGL
scene-the-rendering-equation-by-following-paths = L'équation de rendu, en suivant des chemins de lumière, et l'équation d'éclairage qui la simplifie
scene-coarse-smooth = Grossier | lisse
scene-few-and-many-triangles = Peu et beaucoup de triangles

## panels/compare/truth

scene-traced-the-rendering-equation = Tracé : l'équation de rendu
scene-traced = Tracé
scene-error-the-noise-of-a-pixel = Erreur : le bruit d'un pixel, par rapport à la moyenne de l'image. Quatre fois plus de chemins la divisent par deux.
scene-points-per-lamp-2 = points par lampe
scene-point-lights-that-replace-each-lamp = Nombre de lumières ponctuelles qui remplacent chaque lampe ; 1 : en son centre
scene-points-per-lamp = Points par lampe
scene-simplified-step-by-step-to-the = Simplifié, étape par étape, jusqu'à l'équation d'éclairage
scene-makes-all-simplifications-up-to-this = Fait toutes les simplifications jusqu'à cette étape du cours
scene-step-2 = Étape
scene-the-truth = la vérité
scene-step = étape { $heading }

## panels/equation/mod

scene-term = terme { $term }
scene-a-brdf-has-no-ambient-term = une BRDF n'a pas de terme ambiant
scene-alone-or-all-terms-again = terme { $term } seul, ou de nouveau tous les termes
scene-is-on = terme { $term } activé
scene-is-off = terme { $term } désactivé
scene-alone-2 = terme { $term } seul
scene-show-all-terms-again = Afficher de nouveau tous les termes
scene-show-this-term-alone-or-double = Afficher ce terme seul (ou double-cliquer dessus)
scene-alone = Seul
scene-all-terms-on = Activer tous les termes
scene-all-terms-are-on = tous les termes sont activés
scene-hide-the-definitions = Masquer les définitions
scene-show-the-definitions = Afficher les définitions
scene-definition-of = définition du terme { $term }
scene-click-show-the-lights = Clic : afficher les lumières
scene-click-switch-off-double-click-show = Clic : désactiver. Double-clic : l'afficher seul
scene-click-switch-on-double-click-show = Clic : activer. Double-clic : l'afficher seul
scene-click-switch-off-counts-as-1 = Clic : désactiver (compte pour 1)
scene-click-switch-on = Clic : activer
scene-the-scene-s-ambient-light-is = La lumière ambiante de la scène est { $r }, { $g }, { $b }
scene-no-material-of-this-scene-emits = Aucun matériau de cette scène n'émet de lumière
scene-one-material-of-this-scene-emits = Un matériau de cette scène émet de la lumière
scene-materials-of-this-scene-emit-light = { $n } matériaux de cette scène émettent de la lumière
scene-environment-intensity = Environnement { $image }, intensité { $intensity }
scene-the-diffuse-part-of-the-brdf = La partie diffuse de la BRDF { $brdf }
scene-by-the-convention = Selon la convention { $convention }
scene-the-lobe-of-the-brdf = Le lobe de la BRDF { $brdf }
scene-none-a-click-selects-blinn-phong = Aucun ; un clic choisit Blinn-Phong
scene-0-where-the-light-is-behind-2 = , 0 là où la lumière est derrière la surface
scene-of-lights-are-on = { NUMBER($on) ->
    [one] { $on } lumière allumée sur { $count }
    *[other] { $on } lumières allumées sur { $count }
}
scene-this-scene-has-only-directional-lights = Cette scène n'a que des lumières directionnelles : att vaut 1
scene-applies-to-one-light-directional-lights = S'applique à une lumière ; les lumières directionnelles ont att = 1
scene-applies-to-lights-directional-lights-have = S'applique à { $n } lumières ; les lumières directionnelles ont att = 1
scene-this-scene-has-no-spot-light = Cette scène n'a pas de spot : spot vaut 1
scene-applies-to-one-spot-light-other = S'applique à un spot ; les autres lumières ont spot = 1
scene-applies-to-spot-lights-other-lights = S'applique à { $n } spots ; les autres lumières ont spot = 1
scene-0-where-the-light-is-behind = 0 là où la lumière est derrière la surface

## panels/equation/parameters

scene-intensity-of-the-environment = intensité de l'environnement
scene-this-scene-has-no-environment-select = Cette scène n'a pas d'environnement ; choisissez-en un dans l'onglet Image
scene-the-sum-of-the-ambient-lights = la somme des lumières ambiantes, jamais atténuée
scene-each-light-adds-one-summand = chaque lumière ajoute un terme à la somme
scene-set-per-light-1-for-directional = réglée par lumière ; 1 pour les directionnelles
scene-0-at-the-edge-of-the = 0 au bord du cône, 1 à l'intérieur ; 1 pour les autres lumières
scene-objects-cast-shadows-the-light-of = Les objets projettent des ombres : les lumières directionnelles, les lumières ponctuelles et les spots n'éclairent que ce qu'ils voient
scene-set-per-material = réglé par matériau
scene-flip-the-normal-of-back-faces = Retourner vers l'observateur la normale des faces arrière
scene-specular-model = modèle spéculaire
scene-no-specular-light-where-n-l = Pas de lumière spéculaire là où N⋅L ≤ 0
scene-multiply-the-specular-term-by-n = Multiplier le terme spéculaire par <N.L>, que l'équation du TP omet
scene-times-n-l = fois <N.L>
scene-the-lab-s-diffuse-and-specular = Les termes diffus et spéculaire du TP
scene-a-brdf-1-sr-in-place = Une BRDF (1/sr) à la place des termes diffus et spéculaire ; elle n'a pas de terme ambiant
scene-with-the-factor-that-conserves-energy = Avec le facteur qui conserve l'énergie
scene-diagonal-of-a = diagonale de A
scene-diagonal-of-a-along-tangent-bitangent = Diagonale de A selon la tangente, la bitangente et la normale ; 1, 1, -1 est le lobe de Phong

## panels/frame/draw

scene-samplers-units-textures = Échantillonneurs, unités, textures ({ $count })
scene-this-draw-samples-no-texture = Cet appel de dessin n'échantillonne aucune texture.
scene-uniforms = Uniforms ({ $count })
scene-attributes = Attributs ({ $count })
scene-not-counted-by-this-driver = non compté par ce pilote
scene-not-tested = non testée
scene-written = { $test }, écrite
scene-not-written = { $test }, non écrite
scene-front-is = { $cull }, la face avant est { $front_face }
scene-and = { $first } et { $second }
scene-vertex-shader-runs = vertex shaders exécutés
scene-fragment-shader-runs = fragment shaders exécutés
scene-x-from = { $width } x { $height } depuis { $x }, { $y }
scene-texture = texture { $id },{" "}
scene-reads-unit = lit l'unité { $unit } : { $id }{ $name }
scene-the-sampler-holds-the-texture-unit = L'échantillonneur `{ $name }` contient { $unit }, l'unité de texture à laquelle la texture est liée
scene-no-texture-is-bound-to-this = aucune texture n'est liée à cette unité
scene-1-level = 1 niveau
scene-levels = { $count } niveaux
scene-samples = { NUMBER($samples) ->
    [one] { $samples } échantillon
    *[other] { $samples } échantillons
}
scene-never-set = jamais défini
scene-and-more = et { $rest } de plus
scene-none-the-vertex-shader-computes-the = Aucun : le vertex shader calcule les sommets à partir de gl_VertexID.
scene-for-all-vertices = { $x }, { $y }, { $z }, { $w } pour tous les sommets
scene-program = Programme
scene-vertex-shader = Vertex shader
scene-fragment-shader = Fragment shader

## panels/frame/mod

scene-there-is-no-picture-yet = Il n'y a pas encore d'image.
scene-samples-2 = , { $samples } échantillons
scene-into-x = dans `{ $name }` : { $width } x { $height }{ $samples } { $format }
scene-vertices = { NUMBER($count) ->
    [one] { $other }, { $count } sommet
    *[other] { $other }, { $count } sommets
}
scene-capture-with-renderdoc = Capturer avec RenderDoc
scene-every-draw-texture-and-uniform = Tous les appels de dessin, textures et uniforms de l'image de la vue courante, dans un fichier pour RenderDoc
scene-no-problems-found-in-this-frame = Aucun problème trouvé dans cette trame
scene-every-sampler-reads-a-bound-texture = Chaque échantillonneur lit une texture liée, chaque uniform est défini et chaque attribut a des données.
scene-and-more-2 = {" "}et { $count } de plus
scene-draw = appel { $draw }{ $more }

## panels/lights/details

scene-name = Nom
scene-used-in-reports-and-lists = Utilisé dans les rapports et les listes
scene-kind = Type
scene-kind-of-light = type de lumière
scene-position-in-world-space-at-time = Position dans l'espace du monde, au temps 0 si la lumière se déplace
scene-direction-of-the-light-s-travel = Direction de propagation de la lumière, de longueur quelconque
scene-direction = Direction
scene-colour-of-l-i-linear-rgb = Couleur de L_i, RVB linéaire
scene-colour = Couleur
scene-relative-power-by-wavelength-the-scene = Puissance relative selon la longueur d'onde ; elle vient du fichier de scène. La couleur en est déduite, et une autre couleur remplace le spectre
scene-spectrum = Spectre
scene-radius-of-the-lamp-in-world = Rayon de la lampe, en unités du monde ; l'équation d'éclairage utilise son centre
scene-radius = Rayon
scene-width-and-height-of-the-lamp = Largeur et hauteur de la lampe, en unités du monde ; l'équation d'éclairage utilise son centre
scene-size = Taille
scene-k-c-the-constant-coefficient = k_c, le coefficient constant
scene-k-l-the-linear-coefficient = k_l, le coefficient linéaire
scene-k-q-the-quadratic-coefficient-k = k_q, le coefficient quadratique ; k_c = k_l = 0, k_q = 1 donne la loi de l'inverse du carré
scene-inner-angle = Angle int.
scene-half-angle-of-the-cone-with = Demi-angle du cône de pleine intensité
scene-outer-angle = Angle ext.
scene-half-angle-of-the-cone-outside = Demi-angle du cône hors duquel il n'y a pas de lumière
scene-duplicate-this-light = Dupliquer cette lumière
scene-move-up = Monter
scene-move-down = Descendre
scene-remove-this-light = Supprimer cette lumière
scene-att-at-d = att = { $attenuation } en d = { $distance }
scene-att-as-a-function-of-the = att en fonction de la distance d ; le point marque le centre de la scène
scene-the-light-does-not-move = La lumière ne bouge pas
scene-motion = Mouvement
scene-motion-over-time = Mouvement au cours du temps
scene-period = Période
scene-duration-of-one-cycle-in-seconds = Durée d'un cycle, en secondes
scene-amplitude = Amplitude
scene-largest-displacement-in-world-units = Plus grand déplacement, en unités du monde
scene-centre = Centre
scene-centre-of-the-circle-in-world = Centre du cercle, dans l'espace du monde
scene-axis = Axe
scene-axis-of-rotation = Axe de rotation
scene-point = Point { $number }
scene-in-world-space-the-path-is = Dans l'espace du monde ; la trajectoire est fermée
scene-remove-this-point = Supprimer ce point
scene-add-a-point = Ajouter un point

## panels/lights/edits

scene-copy = { $copy } (copie)
scene-a-light-was-added = lumière ajoutée : { $kind }

## panels/lights/mod

scene-no-lights-only-a-e-and = Aucune lumière : il ne reste que A, E et l'environnement
scene-on-click-to-switch-it-off = allumée ; cliquez pour l'éteindre
scene-off-click-to-switch-it-on = éteinte ; cliquez pour l'allumer
scene-show-all-lights-again = afficher de nouveau toutes les lumières
scene-show-this-light-alone = afficher cette lumière seule
scene-parameters-of = Paramètres de { $name }
scene-intensity-l-i-is-the-colour = Intensité : L_i est la couleur multipliée par l'intensité
scene-colour-of-the-light = couleur de la lumière
scene-colour-of-l-i = Couleur de L_i
scene-add = Ajouter
scene-add-light = Ajouter une lumière : { $kind }

## panels/objects/material

scene-in-the-file = { $one } dans le fichier
scene-and-more-in-the-file-changes = { NUMBER($count) ->
    [one] { $one } et { $count } autre dans le fichier ; les changements s'appliquent à tous
    *[other] { $one } et { $count } autres dans le fichier ; les changements s'appliquent à tous
}
scene-ambient-colour-k-a-linear-rgb = Couleur ambiante k_a, RVB linéaire
scene-diffuse-colour-k-d-linear-rgb = Couleur diffuse k_d, RVB linéaire
scene-reflectance-by-wavelength-0-to-1 = Réflectance selon la longueur d'onde, de 0 à 1 ; elle vient du fichier de scène. k_d en est déduit, et un autre k_d remplace le spectre
scene-specular-colour-k-s-linear-rgb = Couleur spéculaire k_s, RVB linéaire
scene-emitted-light-linear-rgb = Lumière émise, RVB linéaire
scene-shininess-g-the-exponent-of-the = Brillance g : l'exposant du reflet spéculaire
scene-opacity = Opacité
scene-1-is-opaque-0-invisible = 1 est opaque, 0 invisible
scene-textures = Textures
scene-whether-the-model-s-textures-are = Utilisation des textures du modèle
scene-as-in-the-file-2 = comme dans le fichier
scene-ignore-the-textures = Ignorer les textures
scene-an-opaque-surface = Une surface opaque
scene-medium = Milieu
scene-a-transparent-body-of-this-medium = Un corps transparent fait de ce milieu
scene-index = Indice η
scene-index-of-refraction-air-1 = Indice de réfraction (air : 1)
scene-reflectivity = Réflectivité
scene-0-is-the-lit-surface-1 = 0 est la surface éclairée, 1 un miroir
scene-transmission = Transmission
scene-0-is-opaque-1-transparent = 0 est opaque, 1 transparent
scene-default-exact = par défaut (exact)
scene-default-none = par défaut (aucun)
scene-default-schlick = par défaut (Schlick)
scene-exact-for-a-medium-none-for = Exact pour un milieu, aucun pour une surface
scene-fresnel = Fresnel
scene-dependence-of-the-reflection-on-the = Dépendance de la réflexion à l'angle
scene-tint = Teinte
scene-colour-of-the-transmitted-light-0 = Couleur de la lumière transmise, de 0 à 1
scene-absorption = Absorption
scene-per-world-unit-and-channel-between = Par unité du monde et par canal, entre deux surfaces
scene-dispersion = Dispersion
scene-index-of-refraction-for-blue-light = Indice de réfraction pour le bleu moins celui pour le rouge
scene-default-one = par défaut (une)
scene-default-two = par défaut (deux)
scene-as-in-the-lab = Comme dans le TP
scene-surfaces = Surfaces
scene-number-of-surfaces-at-which-light = Nombre de surfaces où la lumière est réfractée
scene-reset-to-the-value-in-the = Revenir à la valeur du fichier
scene-as-in-the-file = Comme dans le fichier

## panels/objects/parts

scene-parts = Parties ({ $count })
scene-all-parts = Toutes les parties
scene-material-of-part = Matériau de { $name }

## panels/objects/mod

scene-bake-textures = Précalculer des textures...
scene-unwrap-the-objects-and-bake-their = Déplier les objets et précalculer leurs couleurs, leurs normales ou leur lumière dans des textures (Ctrl + B)
scene-triangles-2 = { $count } triangles
scene-properties-of = Propriétés de { $name }
scene-material = Matériau
scene-there-is-no-environment-so-this = Il n'y a pas d'environnement : les réflexions et les réfractions de ce matériau ne montrent donc que l'arrière-plan.
scene-add-a-sky = Ajouter un ciel
scene-used-in-reports-and-opengl-debug = Utilisé dans les rapports et les groupes de débogage d'OpenGL
scene-applied-last-in-world-units = Appliquée en dernier, en unités du monde
scene-translation = Translation
scene-about-the-world-s-x-then = Autour des axes x, puis y, puis z du monde
scene-rotation = Rotation
scene-applied-first-per-axis-hold-shift = Appliquée en premier, par axe ; maintenez Shift pour un réglage fin
scene-scale = Échelle
scene-motion-over-time-as-in-the = Mouvement au cours du temps, comme dans le fichier de scène
scene-normals = Normales
scene-source-of-the-mesh-s-normals = Origine des normales du maillage
scene-edges-with-a-larger-angle-stay = Les arêtes d'angle plus grand restent vives ; 180° fait la moyenne de toutes les normales
scene-crease-angle-2 = Angle de pli
scene-crease-angle = angle de pli
scene-triangles-vertices = { $triangles } triangles, { $vertices } sommets
scene-mesh = Maillage
scene-as-it-is-drawn = Tel qu'il est dessiné
scene-frame-this-object = Cadrer cet objet
scene-duplicate-this-object = Dupliquer cet objet
scene-remove-this-object = Supprimer cet objet
scene-a-scene-needs-at-least-one = Une scène a besoin d'au moins un objet
scene-add-a-sample-model = Ajouter un modèle d'exemple
scene-was-added = modèle ajouté : { $name }

## panels/picture

scene-view-of-this-pane = Contenu de cette vue
scene-environment = Environnement
scene-display = Affichage
scene-vectors = Vecteurs
scene-terms = Termes
scene-factors = Facteurs
scene-places = Coordonnées
scene-the-picture = l'image
scene-l-o-with-exposure-tone-mapping = L_o avec exposition, mappage des tons et codage des couleurs
scene-a-vector-term-or-factor-of = Un vecteur, un terme ou un facteur de l'équation comme couleur (touches numériques)
scene-what-is-shown = contenu affiché
scene-sum-of-all = somme de toutes
scene-sum-over-all-lights = Somme sur toutes les lumières
scene-the-first = la première
scene-the-first-light-that-is-not = La première lumière qui n'est pas ambiante
scene-of-light = Lumière
scene-light-whose-contribution-is-shown = Lumière dont la contribution est affichée
scene-of-which-light = de quelle lumière
scene-six-labelled-colours-one-per-face = Six couleurs étiquetées, une par face
scene-a-sky-with-a-sun = Un ciel avec un soleil
scene-a-room-with-windows = Une pièce avec des fenêtres
scene-only-the-background-colours = Seulement les couleurs de l'arrière-plan
scene-from-the-scene = Celle de la scène
scene-image = Image
scene-surroundings-of-the-scene-drop-a = Ce qui entoure la scène ; déposez un panorama ou six faces de cube pour utiliser vos propres images
scene-light = Lumière
scene-whether-the-environment-lights-the-objects = Éclairage des objets par l'environnement
scene-diffuse-light-and-glossy-reflection = Lumière diffuse et réflexion brillante
scene-lights-the-objects = éclaire les objets
scene-background = Arrière-plan
scene-whether-the-environment-is-visible-behind = Visibilité de l'environnement derrière les objets
scene-is-visible = est visible
scene-behind-the-objects = Derrière les objets
scene-intensity = Intensité
scene-factor-on-the-light-of-the = Facteur sur la lumière de l'environnement
scene-yaw-pitch-and-roll-about-y = Lacet, tangage et roulis : autour de y, puis de x, puis de z
scene-yaw-to-the-left = Lacet : vers la gauche
scene-pitch-upwards = Tangage : vers le haut
scene-roll = Roulis
scene-blur = Flou
scene-blur-of-the-visible-environment = Flou de l'environnement visible
scene-top = Haut
scene-colour-at-the-upper-edge-linear = Couleur au bord supérieur, RVB linéaire
scene-background-at-the-top = arrière-plan en haut
scene-bottom = Bas
scene-colour-at-the-lower-edge-linear = Couleur au bord inférieur, RVB linéaire
scene-background-at-the-bottom = arrière-plan en bas
scene-saved-pictures-get-an-alpha-channel = Les images enregistrées ont un canal alpha
scene-exposure = Exposition
scene-stops-each-doubles-the-light = En diaphragmes (EV) : chacun double la lumière
scene-tone-map-2 = Tons
scene-maps-light-above-1-to-the = Ramène la lumière supérieure à 1 dans la plage de l'écran
scene-tone-map = mappage des tons
scene-encoding = Codage
scene-conversion-of-linear-light-to-the = Conversion de la lumière linéaire en valeurs de l'image
scene-colour-encoding = codage des couleurs
scene-samples-3 = Échantillons
scene-samples-per-pixel-for-smooth-edges = Échantillons par pixel, pour des bords lisses
scene-samples-per-pixel = échantillons par pixel
scene-texture-filter-2 = Filtrage des textures
scene-texture-filter = filtrage des textures

## panels/probe/bars

scene-mirror-and-glass = miroir et verre
scene-bar-length-luminance = { $n }
    longueur de la barre : luminance

## panels/probe/lights

scene-corner-vertex-weight = Coin { $number } : sommet { $vertex }, poids { $weight }
scene-at-the-centroid-of-the-triangle = Au centre de gravité du triangle
scene-interpolated = Interpolé
scene-diffuse-light = lumière diffuse
scene-sum-of-diff-n-l-i = Somme des diff <N.L_i> L_i att_i spot_i
scene-specular-light = lumière spéculaire
scene-sum-of-spec-i-l-i = Somme des spec_i L_i att_i spot_i
scene-cosine-of-the-angle-between-normal = Cosinus de l'angle entre la normale et la direction de la lumière
scene-attenuation-with-distance = Atténuation avec la distance
scene-spot-cone-factor = Facteur du cône du spot
scene-1-or-1-pi-in-the = 1, ou 1/pi dans la convention physique
scene-specular-factor-without-k-s = Facteur spéculaire, sans k_s
scene-n-l-behind-the-surface = N.L { $cos_theta } : derrière la surface
scene-to-the-light-world-space = Vers la lumière, espace du monde
scene-l-mirrored-about-n = Symétrique de L par rapport à N
scene-halfway-between-l-and-v = À mi-chemin entre L et V
scene-incident-light-linear-rgb = Lumière incidente, RVB linéaire
scene-world-space = Espace du monde
scene-the-normal-at-this-point = La normale en ce point
scene-n-l-att-spot-spec = { $of } : N.L { $cos_theta }, att { $attenuation }, spot { $spot }, spec { $spec }
scene-diffuse = { $of } : diffus
scene-specular = { $of } : spéculaire

## panels/probe/mod

scene-preparing-the-cpu-reference-triangles = préparation de la référence CPU : { $triangles } triangles
scene-point-at-the-picture-to-see = Placez le pointeur sur l'image pour voir en nombres l'équation d'éclairage de ce pixel. Un clic épingle le pixel, Escape le désépingle.
scene-the-environment = l'environnement
scene-the-background = l'arrière-plan
scene-this-pixel-shows = Ce pixel montre { $what }.
scene-the-light-equation-by-source = L'équation d'éclairage, par source
scene-light-by-source = La lumière, par source
scene-the-light-equation-in-numbers = L'équation d'éclairage en nombres
scene-the-equation-in-numbers = L'équation en nombres
scene-traced-light-by-the-way-it = La lumière tracée, selon son chemin
scene-the-first-paths-are-on-their = Les premiers chemins sont en cours de calcul.
scene-a-click-pins-a-pixel-and = Un clic épingle un pixel, et des chemins de lumière y sont suivis.
scene-linear-rgb-mean-of-paths-through = RVB linéaire, moyenne de { $paths } chemins à travers le pixel
scene-paths-through-the-pixel = chemins à travers le pixel
scene-no-pixel = aucun pixel
scene-pixel = pixel { $x }, { $y }
scene-of-x-2 = sur { $width } x { $height }
scene-unpin-the-pixel-escape = Désépingler le pixel (Escape)
scene-click-in-the-picture-to-pin = Cliquez dans l'image pour épingler un pixel
scene-show-or-hide-the-lobe-at = Afficher ou masquer le lobe au pixel épinglé : la lumière réfléchie dans chaque direction
scene-copy-all-numbers-as-json = Copier tous les nombres en JSON
scene-copy-as-text = Copier comme texte
scene-light-equation-by-the-cpu-reference = Équation d'éclairage par la référence CPU en f64 au centre du pixel, RVB linéaire
scene-light-equation-by-opengl-with-one = Équation d'éclairage par OpenGL avec un échantillon, RVB linéaire
scene-rendering-equation-by-paths-through-the = Équation de rendu par des chemins à travers tout le pixel, RVB linéaire
scene-largest-difference-of-cpu-and-opengl = plus grande différence entre CPU et OpenGL : { $difference }
scene-largest-difference = plus grande différence
scene-the-opengl-value-could-not-be = La valeur d'OpenGL n'a pas pu être lue
scene-of-x = { $x }, { $y } sur { $width } x { $height }
scene-traced-2 = tracé { $name }
scene-weights = { $triangle }, poids { $barycentrics }
scene-factors-2 = {"  "}facteurs
scene-diffuse-2 = {"  "}diffus
scene-specular-2 = {"  "}spéculaire

## panels/probe/sum

scene-terms-that-are-switched-off-count = Les termes désactivés comptent pour 0 ; l'atténuation et le cône du spot comptent pour 1.
scene-with-the-reflected-and-refracted-environment = avec l'environnement réfléchi et réfracté : { $r }  { $g }  { $b }

## panels/probe/surface

scene-surface = Surface
scene-the-shading-normal = La normale d'ombrage
scene-n-geometric = N géométrique
scene-normal-of-the-triangle = Normale du triangle
scene-to-the-eye = Vers l'œil
scene-material-2 = Matériau { $material_name }
scene-edit-material-of-part = Modifier le matériau de cette partie
scene-ambient = Ambiant
scene-diffuse-textures-included = Diffus, textures comprises
scene-specular-textures-included = Spéculaire, textures comprises
scene-emitted = Émis
scene-shininess-index-of-refraction = brillance { $shininess }   indice de réfraction { $refraction_index }
scene-part = , partie { $part_name }
scene-of-vertices = { $triangle }, de sommets { $a }, { $b }, { $c }
scene-back-n-flipped-towards-the-viewer = arrière, N retournée vers l'observateur
scene-surfaces-visible-through-it = { NUMBER($behind) ->
    [one] { $opacity }, { $behind } surface visible au travers
    *[other] { $opacity }, { $behind } surfaces visibles au travers
}
scene-at = { $value }  en { $x }, { $y }
scene-environment-2 = Environnement { $name }
scene-k-d-times-the-irradiance-about = k_d fois l'éclairement autour de N
scene-its-glossy-reflection = Sa réflexion brillante
scene-v-mirrored-about-n = Symétrique de V par rapport à N
scene-reflected-environment = Environnement réfléchi
scene-refracted-environment = Environnement réfracté
scene-fresnel-reflectance-per-channel = Réflectance de Fresnel par canal
scene-no-fresnel = sans Fresnel
scene-exact-fresnel = Fresnel exact
scene-schlick-s-fresnel = Fresnel de Schlick
scene-mirror-transmission = miroir { $share }   transmission { $transmission }   { $fresnel }

## panels/shaders

scene-your-shaders = Vos shaders
scene-uniforms-2 = Uniforms
scene-none-no-program-has-been-compiled = Aucun : aucun programme n'a été compilé.
scene-the-program-has-none = Le programme n'en a pas.
scene-show-the-texts = Afficher le code
scene-show-each-line-s-values-at = Afficher les valeurs de chaque ligne en un pixel : cliquez sur l'image, ou ici pour le pixel central (F9)
scene-close-your-shaders-gonio-s-own = Fermer vos shaders : ceux de gonio dessinent l'image
scene-a-click-on-the-picture-shows = Un clic sur l'image affiche les valeurs de chaque ligne en ce pixel.
scene-close-the-texts = Fermer le code
scene-vertex = Vertex
scene-fragment = Fragment
scene-the-window-reads-the-file-again = La fenêtre relit le fichier quand il change
scene-gonio-s-own = celui de gonio
scene-compiled = Compilé.
scene-compiling = Compilation en cours.
scene-these-texts-do-not-compile-the = Ce code ne compile pas : le dernier programme qui a compilé est dessiné.
scene-these-texts-do-not-compile-gonio = Ce code ne compile pas : les shaders de gonio dessinent l'image.
scene-state-of-your-shaders = état de vos shaders
scene-show-the-line = Afficher la ligne
scene-choose-the-value = Choisir la valeur
scene-back-to-gonio-s-value = Revenir à la valeur de gonio
scene-as-it-is-shown-not-decoded = Telle qu'elle est affichée : non décodée

## scene_view/arrangement

scene-divider-between-two-panes = séparation entre deux vues
scene-the-difference-needs-both-pictures = la différence a besoin des deux images
scene-minus = { $second } moins { $first }
scene-difference-of-and = différence entre { $first } et { $second }
scene-of-255 = sur 255

## scene_view/axes

scene-look-along = Regarder le long de { $name }

## scene_view/drawing/comparison

scene-triangles-phong = { $count } triangles, Phong

## scene_view/gizmos/mod

scene-outside-of-the-picture-drag-to = {"   "}hors de l'image : faites-la glisser pour la ramener
scene-direction-of-the-light = direction de la lumière
scene-outer-angle-2 = angle extérieur
scene-light-2 = lumière { $index } ({ $name })

## scene_view/lobe/paint

scene-towards-v-of-the-peak = vers V { $value }, { $share } % du maximum

## scene_view/observer

scene-the-camera-and-its-frustum-from = la caméra et son volume de vision, vus de l'extérieur
scene-close-o = Fermer (O)
scene-rotate-automatically = Tourner automatiquement

## scene_view/pane

scene-picture-of-the-scene = image de la scène

## scene_view/toolbar

scene-traced-truth = Tracé (vérité)
scene-solves-the-rendering-equation-by-following = Résout l'équation de rendu en suivant des chemins de lumière : les ombres, la lumière entre les surfaces et tout ce que l'équation d'éclairage laisse de côté. L'image est d'abord grossière, puis s'affine tant que rien ne change.
scene-overlays-are-not-drawn-over-it-2 = Les superpositions n'y sont pas dessinées, et elle a tous les triangles quel que soit le niveau de détail.
scene-overlays-are-not-drawn-over-it = Les superpositions n'y sont pas dessinées.
scene-view-of-the-scene-number-keys = Contenu de la vue (touches numériques)
scene-first-light = première lumière
scene-light-3 = lumière { $light }
scene-wireframe-shift-w = Fil de fer (Shift + W)
scene-normals-shift-n = Normales (Shift + N)
scene-up-axis = Axe vertical
scene-up-axis-tip = L'axe du modèle qui pointe vers le haut : y en glTF, le plus souvent z en STL. F recadre l'objet
scene-ground-shift-g = Sol avec une ombre de contact (Shift + G). Une aide : elle ne fait partie ni de l'équation d'éclairage, ni des images enregistrées, ni des valeurs
scene-bounding-boxes-shift-b = Boîtes englobantes (Shift + B)
scene-show-the-camera-and-its-frustum = Afficher la caméra et son volume de vision vus de l'extérieur (O)
scene-probe-the-pixel-under-the-pointer = Sonder le pixel sous le pointeur (P)

## states and titles

scene-picture = image
scene-traced-picture = tracé
scene-on = oui
scene-off = non
scene-front = avant
scene-back = arrière
scene-intensity-label = intensité
scene-unnamed = sans nom
scene-triangles-column = triangles
scene-vertices-column = sommets
scene-fragments-column = fragments
scene-shading-column = ombrage
scene-lit-column = éclairé
scene-equal = identiques
scene-wireframe = fil de fer
scene-normals-overlay = normales
scene-boxes = boîtes
scene-simplifying = {" "}(simplification en cours)
scene-passes = { NUMBER($count) ->
    [one] { $count } passe
    *[other] { $count } passes
}
scene-draws = { NUMBER($count) ->
    [one] { $count } appel de dessin
    *[other] { $count } appels de dessin
}
scene-nothing = rien
scene-triangles-drawn = { NUMBER($count) ->
    [one] { $count } triangle
    *[other] { $count } triangles
}
scene-if = {"   "}si{" "}
