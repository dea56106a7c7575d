# Names and descriptions that other crates have in English: see `gonio_language::name`.


## Grandeurs de l'équation

name-normal = normale
name-geometric-normal = normale géométrique
name-tangent = tangente
name-position = position
name-depth = profondeur
name-uv = uv
name-view = vue
name-light = lumière
name-reflection = réflexion
name-half = demi-vecteur
name-refraction = réfraction
name-view-reflection = réflexion de la vue
name-distance = distance
name-attenuation = atténuation
name-spot = cône
name-visibility = visibilité
name-cos-theta = cos thêta
name-spec = spec
name-fresnel = Fresnel
name-albedo = albédo
name-ambient = ambiant
name-emitted = émis
name-diffuse = diffus
name-specular = spéculaire
name-environment-diffuse = environnement diffus
name-environment-specular = environnement spéculaire
name-reflected = réfléchi
name-transmitted = transmis
name-total = total
name-n-the-shading-normal-world-space = `N`, la normale d'ombrage, dans l'espace du monde.
name-the-triangle-s-own-normal-world-space = La normale du triangle lui-même, dans l'espace du monde.
name-the-tangent-world-space = La tangente, dans l'espace du monde.
name-the-point-world-space = Le point, dans l'espace du monde.
name-distance-from-the-eye-along-the-viewing-direction = Distance à l'œil le long de la direction de visée, en unités du monde.
name-texture-coordinates = Coordonnées de texture.
name-v-to-the-eye = `V`, vers l'œil.
name-l-to-the-light = `L`, vers la lumière.
name-r-2-n-l-n-l = `R = 2 (N.L) N - L`.
name-h-l-v-l-v = `H = (L + V) / |L + V|`.
name-t-the-view-direction-refracted-into-the-material = 2 (N.V) N - V where reflection is total). = `T`, la direction de vue réfractée dans le matériau (R' = 2 (N.V) N - V là où la réflexion est totale).
name-2-n-v-n-v-where-a-mirror = `2 (N.V) N - V` : là où regarde un miroir.
name-d-distance-to-the-light-world-units-0 = `d`, la distance à la lumière, en unités du monde (0 pour les lumières directionnelles).
name-v-the-share-of-the-light-that-reaches = `v`, la part de la lumière qui atteint le point : 0 dans une ombre ; 1 si les ombres sont désactivées.
name-f-of-the-view-without-a-fresnel-factor = `F` de la vue, 0 sans facteur de Fresnel ; 1 là où la réflexion est totale.
name-k-d-the-material-s-diffuse-colour-with = `k_d`, la couleur diffuse du matériau avec sa texture.
name-the-diffuse-term-summed-over-the-lights-or = Le terme diffus : la somme sur les lumières, ou celui d'une seule.
name-the-specular-term-summed-over-the-lights-or = Le terme spéculaire : la somme sur les lumières, ou celui d'une seule.
name-diffuse-light-of-the-environment-times-k-d = Lumière diffuse de l'environnement, multipliée par `k_d`.
name-glossy-reflection-of-the-environment-times-k-s = Réflexion brillante de l'environnement, multipliée par `k_s`.
name-e-r-what-a-mirror-would-show = `E(R)`, ce que montrerait un miroir.
name-1-f-tint-e-t-what-clear-glass = `(1 - F) teinte E(T)`, ce que laisserait voir un verre clair.
name-l-o-before-exposure-and-tone-mapping = `L_o`, avant l'exposition et le mappage des tons.
name-a = `A`.
name-e = `E`.
name-att = `att`.
name-n-l = `<N.L>`.

## Lumières

name-directional = directionnelle
name-point = ponctuelle
name-rectangle = rectangulaire
name-light-from-everywhere-adds-to-a = Lumière venant de partout ; s'ajoute à A.
name-parallel-rays-along-direction = Rayons parallèles le long de `direction`.
name-light-from-position-in-all-directions = Lumière émise depuis `position` dans toutes les directions.
name-light-from-position-within-a-cone-about-direction = Lumière émise depuis `position` dans un cône autour de `direction`.
name-a-flat-lamp-at-position-that-shines-to = Lampe plane en `position`, qui éclaire du côté de `direction`.

## Ombrage

name-flat = plat
name-flat-per-face = plat, par face
name-gouraud = Gouraud
name-phong = Phong
name-one-normal-per-triangle-the-equation-at-every = Une normale par triangle, l'équation à chaque fragment.
name-one-normal-per-triangle-the-equation-once-per = Une normale par triangle, l'équation une fois par triangle, en son centre.
name-the-equation-at-the-vertices-the-light-interpolated = L'équation aux sommets, la lumière interpolée.
name-the-normal-interpolated-and-renormalised-the-equation-at = La normale interpolée et renormalisée, l'équation à chaque fragment.
name-file = fichier
name-averaged = moyennées
name-y-as-in-gltf-and-in-the-world = y, comme en glTF et dans le monde.
name-z-as-in-cad-in-files-for-3d = z, comme en CAO, dans les fichiers pour imprimantes 3D et dans Blender.
name-the-file-s-averaged-where-it-has-none = Celles du fichier ; moyennées s'il n'en a pas.
name-one-per-triangle = Une par triangle.
name-angle-weighted-mean-over-adjacent-faces-the-file = Moyenne sur les faces voisines, pondérée par les angles ; celles du fichier sont ignorées.

## Vues spéciales, textures

name-uv-checker = damier uv
name-overdraw = surdessin
name-nothing = rien
name-the-texture-coordinates-eight-by-eight-squares-for = Les coordonnées de texture : huit carrés par unité, le rouge croît avec u et le vert avec v.
name-the-number-of-fragments-shaded-at-each-pixel = Le nombre de fragments ombrés à chaque pixel.
name-the-background-only-for-overlays-by-themselves = L'arrière-plan seul, pour voir les superpositions isolément.
name-nearest = plus proche
name-linear = linéaire
name-mipmap = mipmap
name-anisotropic = anisotrope
name-the-nearest-texel = Le texel le plus proche.
name-four-texels-of-the-full-picture-no-mipmaps = Quatre texels de l'image entière, sans mipmaps.
name-trilinear = Trilinéaire.
name-trilinear-up-to-16-times-along-the-footprint = Trilinéaire, jusqu'à 16 fois le long du grand axe de l'empreinte.

## Courbes des BRDF

name-log = logarithmique
name-cube-root = racine cubique
name-lengths-are-proportional-to-values = Les longueurs sont proportionnelles aux valeurs
name-equal-lengths-are-equal-factors-over-five-powers = À longueurs égales, facteurs égaux, sur cinq puissances de dix sous la plus grande valeur
name-lengths-are-proportional-to-cube-roots-which-show = Les longueurs sont proportionnelles aux racines cubiques, qui montrent ensemble les reflets et le reste
name-polar = polaire
name-cartesian = cartésienne
name-lobe = lobe
name-slice = coupe
name-sphere = sphère
name-reciprocity = réciprocité
name-samples = échantillons
name-values-in-the-plane-of-incidence-as-distances = Les valeurs dans le plan d'incidence, comme distances au point
name-values-over-an-angle = Les valeurs en fonction d'un angle
name-values-of-all-directions-as-a-surface = Les valeurs de toutes les directions, comme surface
name-values-over-half-and-difference-angle-the-image = Les valeurs selon l'angle moitié et l'angle de différence, la coupe usuelle des BRDF mesurées
name-a-sphere-lit-by-one-light = Une sphère éclairée par une lumière
name-the-share-of-light-that-is-reflected-over = La part de lumière réfléchie, en fonction de l'angle d'incidence
name-the-difference-when-light-and-viewer-change-places = La différence quand lumière et observateur échangent leurs places, en fonction de l'angle d'incidence
name-fresnel-factors-of-the-first-model-that-has = Les facteurs de Fresnel du premier modèle qui a un indice de réfraction
name-directions-drawn-by-importance-sampling = Directions tirées par échantillonnage préférentiel
name-theta-o = thêta o
name-phi-o = phi o
name-theta-i = thêta i
name-theta-h = thêta h
name-theta-d = thêta d
name-polar-angle-of-the-viewer-in-the-plane = Angle polaire de l'observateur dans le plan d'incidence, négatif du côté de la lumière
name-azimuth-of-the-viewer-relative-to-the-light = Azimut de l'observateur par rapport à la lumière, à l'angle polaire de la direction miroir
name-polar-angle-of-the-light-with-the-viewer = Angle polaire de la lumière, l'observateur étant dans la direction miroir
name-half-angle-with-the-difference-angle-of-the = Angle moitié, avec l'angle de différence de l'incidence
name-difference-angle-with-the-half-vector-along-the = Angle de différence, le demi-vecteur étant le long de la normale

## Couleurs et image

name-srgb = sRGB
name-direct = direct
name-the-srgb-transfer-function-after-exposure-and-tone = La fonction de transfert sRGB, après l'exposition et le mappage des tons.
name-the-sum-unencoded-clamped-to-0-1-as = La somme sans codage, bornée à [0, 1], comme dans les programmes du TP. L'exposition et le mappage des tons s'appliquent s'ils sont demandés ; seule la courbe sRGB est omise.
name-none = aucun
name-reinhard = Reinhard
name-aces = ACES
name-agx = AgX
name-clamped = Bornée.
name-x-1-x-per-channel-reinhard-et-al = `x / (1 + x)` par canal (Reinhard et al. 2002).
name-a-rational-fit-of-the-aces-filmic-curve = Une approximation rationnelle de la courbe filmique ACES (Narkowicz 2015).
name-agx-polynomial-fit-of-its-default-look-sobotka = AgX, approximation polynomiale de son rendu par défaut (Sobotka 2022, approchée par Wrensch 2023).

## Équation et optique

name-lab = TP
name-physical = physique
name-diff-1-as-in-the-lab-l-i = `diff = 1`, comme dans le TP ; `L_i` est une couleur.
name-diff-1-pi-l-i-is-a-radiometric = `diff = 1/pi` ; `L_i` est une grandeur radiométrique (ponctuelle : intensité en W/sr).
name-blinn-phong = Blinn-Phong
name-no-specular-term = Pas de terme spéculaire.
name-r-v-shininess = `<R.V>^brillance`
name-n-h-shininess = `<N.H>^brillance`
name-exact = exact
name-schlick = Schlick
name-independent-of-the-angle-as-in-the-lab = Indépendant de l'angle, comme dans le TP ; la réflexion est totale là où il n'y a pas de réfraction.
name-fresnel-s-equations-for-unpolarised-light-and-a = Les équations de Fresnel pour une lumière non polarisée et un diélectrique.
name-schlick-s-approximation = L'approximation de Schlick.
name-one = une
name-two = deux
name-the-first-one-only-as-in-the-lab = La première seulement, comme dans le TP.
name-the-surfaces-where-the-ray-enters-and-leaves = Les surfaces où le rayon entre et sort, avec des réflexions totales entre les deux ; le corps doit être fermé.

## Simplifications

name-time = temps
name-wavelengths = longueurs d'onde
name-emission = émission
name-brdf = BRDF
name-interreflection = interréflexions
name-shadows = ombres
name-cosine = cosinus
name-sum = somme
name-light-is-constant-in-time-the-shutter-is = La lumière est constante dans le temps : l'obturateur n'est ouvert qu'un instant.
name-light-has-three-channels-red-green-and-blue = La lumière a trois canaux, rouge, vert et bleu, au lieu d'un spectre.
name-an-object-emits-the-same-radiance-everywhere-the = Un objet émet partout la même radiance : la moyenne de sa texture d'émission.
name-a-material-is-a-diffuse-and-a-specular = Un matériau est un terme diffus et un terme spéculaire : ni miroir, ni verre, ni conservation de l'énergie.
name-surfaces-are-lit-by-light-sources-only-not = Les surfaces ne sont éclairées que par les sources de lumière, pas par les autres surfaces.
name-nothing-blocks-light = Rien n'arrête la lumière.
name-the-specular-term-loses-its-cosine-as-the = Le terme spéculaire perd son cosinus, comme le dit l'équation de la scène.
name-light-falls-with-1-kc-kl-d-kq = La lumière décroît en 1/(kc + kl d + kq d^2) au lieu du carré de la distance.
name-the-integral-over-all-directions-becomes-a-sum = L'intégrale sur toutes les directions devient une somme sur des lumières ponctuelles.
name-an-ambient-term-is-added = Un terme ambiant est ajouté.

## Milieux, mouvements, cartes

name-water = eau
name-glass = verre
name-diamond = diamant

## Mots courts

name-environment = environnement
name-lights = lumières
name-object = objet
name-triangle = triangle
name-weights = poids
name-side = côté
name-shading = ombrage
name-opacity = opacité
name-shininess = brillance
name-traced = tracé
name-pixel = pixel
name-material = matériau
name-drawn = dessiné
name-culled = écarté
name-blending = mélange
name-viewport = fenêtre
name-intensity = intensité
name-radius = rayon
name-width = largeur
name-height = hauteur
name-yes = oui
name-no = non
name-two-sided = deux faces
name-normalised = normalisée
name-gated = conditionnel
name-convention = convention
name-gl = OpenGL
name-seen = vu
name-sky = ciel
name-room = pièce
name-debug = repères
name-transparent = transparent
name-the-lab-s = celle du TP
name-turned = tournée
name-stretched = étirée
name-the-sky = le ciel
name-symptom = symptôme
name-name = nom
name-line = ligne
name-fix = correction
name-yours = la vôtre
name-reference = référence
name-both = les deux
name-difference = différence
name-coarse = grossier
name-photographic = photographique
name-size = taille
name-colour = couleur
name-spectrum = spectre
name-motion = mouvement
name-period = période
name-amplitude = amplitude
name-centre = centre
name-axis = axe
name-translation = translation
name-rotation = rotation
name-scale = échelle
name-medium = milieu
name-direction = direction
name-equal = égal
