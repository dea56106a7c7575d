// Exercise 02: an object reader, complete.
//
//     g++ -std=c++17 obj_reader.cpp -o obj_reader
//     ./obj_reader models/cube.obj cube.raw
//     gonio lab check ex02 cube.raw
//
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
            } else if (indice == "f") {
                std::vector<Vertex> corners;
                std::string word;
                while (iss >> word) corners.push_back(corner(word));
                addPolygon(corners);
            }
        }
    }

    // Writes the bytes for glBufferData: x y z u v nx ny nz, 32-bit floats.
    void writeRaw(const std::string& path) const {
        std::ofstream out(path, std::ios::binary);
        out.write(reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof(Vertex));
    }

private:
    // The item that an index refers to: from 1, or back from the last one read so far. An empty slot gives zero.
    template <typename T>
    static T element(const std::vector<T>& list, const std::string& index) {
        if (index.empty()) return T();
        int i = std::stoi(index);
        return list.at(i > 0 ? i - 1 : list.size() + i);
    }

    // v, v/vt, v//vn or v/vt/vn.
    Vertex corner(const std::string& word) const {
        std::string slots[3];
        std::istringstream parts(word);
        for (std::string& slot : slots) std::getline(parts, slot, '/');
        Vertex v;
        v.Position = element(positions, slots[0]);
        v.Texture = element(textures, slots[1]);
        v.Normal = element(normals, slots[2]);
        return v;
    }

    static Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
    static Vec3 minus(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    static float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

    // Positive if a, b, c turn in the same direction as the polygon.
    static float turn(const Vertex& a, const Vertex& b, const Vertex& c, Vec3 normal) {
        return dot(cross(minus(b.Position, a.Position), minus(c.Position, b.Position)), normal);
    }

    // Cuts off ears until a triangle is left.
    void addPolygon(std::vector<Vertex> left) {
        if (left.size() < 3) return;
        Vec3 normal;
        for (size_t i = 0; i < left.size(); i++) {
            Vec3 n = cross(left[i].Position, left[(i + 1) % left.size()].Position);
            normal = {normal.x + n.x, normal.y + n.y, normal.z + n.z};
        }
        while (left.size() > 3) {
            size_t n = left.size(), ear = 1;
            for (size_t i = 0; i < n; i++) {
                if (isEar(left, i, normal)) {
                    ear = i;
                    break;
                }
            }
            vertices.push_back(left[(ear + n - 1) % n]);
            vertices.push_back(left[ear]);
            vertices.push_back(left[(ear + 1) % n]);
            left.erase(left.begin() + ear);
        }
        vertices.insert(vertices.end(), left.begin(), left.end());
    }

    // Whether a corner points outwards, and no other corner is inside its triangle.
    static bool isEar(const std::vector<Vertex>& left, size_t i, Vec3 normal) {
        size_t n = left.size(), before = (i + n - 1) % n, after = (i + 1) % n;
        const Vertex &a = left[before], &b = left[i], &c = left[after];
        if (turn(a, b, c, normal) <= 0) return false;
        for (size_t k = 0; k < n; k++) {
            if (k == before || k == i || k == after) continue;
            const Vertex& p = left[k];
            if (turn(a, b, p, normal) >= 0 && turn(b, c, p, normal) >= 0 && turn(c, a, p, normal) >= 0) return false;
        }
        return true;
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
