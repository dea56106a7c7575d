// Exercise 02: an object reader.
//
//     g++ -std=c++17 obj_reader.cpp -o obj_reader
//     ./obj_reader models/cube.obj cube.raw
//     gonio lab check ex02 cube.raw
//
// It compiles and runs, but its output is not yet the cube: it does not read the faces.
// In your own program, use glm::vec3 and glm::vec2, and pass `vertices` to glBufferData.

#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

struct Vec3 { float x = 0, y = 0, z = 0; };
struct Vec2 { float x = 0, y = 0; };

struct Vertex {
    Vec3 Position;
    Vec2 Texture;
    Vec3 Normal;
};

class Object {
public:
    std::vector<Vec3> positions;
    std::vector<Vec2> textures;
    std::vector<Vec3> normals;
    std::vector<Vertex> vertices;

    explicit Object(const std::string& path) {
        std::ifstream infile(path);
        std::string line;
        while (std::getline(infile, line)) {
            std::istringstream iss(line);
            std::string indice;
            iss >> indice;
            if (indice == "v") {
                Vec3 p;
                iss >> p.x >> p.y >> p.z;
                positions.push_back(p);
            } else if (indice == "vt") {
                Vec2 t;
                iss >> t.x >> t.y;
                textures.push_back(t);
            } else if (indice == "vn") {
                Vec3 n;
                iss >> n.x >> n.y >> n.z;
                normals.push_back(n);
            }
            // TODO: the f lines. What do the numbers between the slashes mean? Where do they start counting?
            // What if a face has four corners, or five?
        }
        // TODO: do not combine the lists by position, but as the corners of the faces define.
        for (size_t i = 0; i < positions.size(); i++) {
            Vertex v;
            v.Position = positions[i];
            if (i < textures.size()) v.Texture = textures[i];
            if (i < normals.size()) v.Normal = normals[i];
            vertices.push_back(v);
        }
    }

    // Writes the bytes for glBufferData: x y z u v nx ny nz, 32-bit floats.
    void writeRaw(const std::string& path) const {
        std::ofstream out(path, std::ios::binary);
        out.write(reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof(Vertex));
    }
};

int main(int argc, char* argv[]) {
    if (argc != 3) {
        std::cerr << "usage: obj_reader MODEL.obj BUFFER.raw\n";
        return 1;
    }
    Object object(argv[1]);
    object.writeRaw(argv[2]);
    std::cout << object.vertices.size() << " vertices\n";
}
