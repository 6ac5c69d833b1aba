#include "studio/view/pictures.h"

struct StudioPictures {
    GHashTable *textures; // key → texture
};

static gint64 key_of(FrDigest look, FrMap map) {
    return (gint64)fr_digest(look, &map, sizeof map);
}

static void delete_texture(gpointer texture) {
    GLuint name = GPOINTER_TO_UINT(texture);
    glDeleteTextures(1, &name);
}

StudioPictures *studio_pictures_new(void) {
    StudioPictures *pictures = g_new0(StudioPictures, 1);
    pictures->textures = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, delete_texture);
    return pictures;
}

void studio_pictures_free(StudioPictures *pictures) {
    g_hash_table_unref(pictures->textures);
    g_free(pictures);
}

void studio_pictures_add(StudioPictures *pictures, const StudioPicture *picture) {
    const FrImage *image = picture->image;
    if (image == NULL) {
        return;
    }
    static const GLenum formats[] = {0, GL_RED, GL_RG, GL_RGB, GL_RGBA};
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, picture->map == FR_MAP_COLOUR ? GL_SRGB8_ALPHA8 : GL_RGBA8,
                 (GLsizei)image->width, (GLsizei)image->height, 0, formats[image->channels],
                 GL_UNSIGNED_BYTE, image->pixels);
    if (image->channels < 3) {
        const GLint grey[] = {GL_RED, GL_RED, GL_RED, image->channels == 2 ? GL_GREEN : GL_ONE};
        glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, grey);
    }
    glGenerateMipmap(GL_TEXTURE_2D);
    GLint wrap = picture->is_clamped ? GL_CLAMP_TO_EDGE : GL_REPEAT;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    gint64 key = key_of(picture->digest, picture->map);
    g_hash_table_insert(pictures->textures, g_memdup2(&key, sizeof key), GUINT_TO_POINTER(texture));
}

GLuint studio_pictures_find(const StudioPictures *pictures, FrDigest look, FrMap map) {
    gint64 key = key_of(look, map);
    return GPOINTER_TO_UINT(g_hash_table_lookup(pictures->textures, &key));
}
