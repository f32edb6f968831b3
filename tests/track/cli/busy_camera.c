/* Loaded before the C library, gives a program a camera that gives no pictures: /dev/video42, or what CAMERA_DEVICE names.
 *
 * It answers as Linux' drivers do (kernel documentation, "Multiple Opens"), by CAMERA_SAYS: without, or with EBUSY, anyone
 * may open the device and ask what it can, but who sets a format or asks for buffers gets EBUSY. With EACCES nobody may open
 * it, with ENOSPC its pictures do not fit through the USB port, and METADATA makes it a node without pictures. What it
 * answers is also said on standard error, so that a test knows. Everything else goes on to the C library.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int device = -1;

static const char *environment(const char *name, const char *usual)
{
    const char *value = getenv(name);
    return value ? value : usual;
}

static int says(const char *word)
{
    return strcmp(environment("CAMERA_SAYS", "EBUSY"), word) == 0;
}

static int refuse(int error, const char *word)
{
    dprintf(2, "the camera says %s\n", word);
    errno = error;
    return -1;
}

static int real_open(const char *symbol, const char *path, int flags, mode_t mode)
{
    int (*next)(const char *, int, ...) = dlsym(RTLD_NEXT, symbol);
    if (strcmp(path, environment("CAMERA_DEVICE", "/dev/video42")) == 0)
        return says("EACCES") ? refuse(EACCES, "EACCES") : (device = next("/dev/null", O_RDWR));
    return next(path, flags, mode);
}

#define OPENER(name)                                                                                                   \
    int name(const char *path, int flags, ...)                                                                         \
    {                                                                                                                  \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;                                        \
        va_end(rest);                                                                                                  \
        return real_open(#name, path, flags, mode);                                                                    \
    }
OPENER(open)
OPENER(open64)

int ioctl(int file, unsigned long request, ...)
{
    va_list rest;
    va_start(rest, request);
    void *argument = va_arg(rest, void *);
    va_end(rest);
    if (file != device || device < 0) {
        int (*next)(int, unsigned long, ...) = dlsym(RTLD_NEXT, "ioctl");
        return next(file, request, argument);
    }
    switch (request) {
    case VIDIOC_QUERYCAP: {
        struct v4l2_capability *capability = argument;
        memset(capability, 0, sizeof *capability);
        strcpy((char *)capability->driver, "uvcvideo");
        strcpy((char *)capability->card, "Mouth Tracker");
        capability->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
        capability->device_caps = says("METADATA") ? V4L2_CAP_META_CAPTURE : V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
    }
    case VIDIOC_G_INPUT:
        *(int *)argument = 0;
        return 0;
    case VIDIOC_S_INPUT:
    case VIDIOC_TRY_FMT:
    case VIDIOC_G_FMT:
        return 0;
    case VIDIOC_S_FMT:
    case VIDIOC_REQBUFS:
        return says("EBUSY") ? refuse(EBUSY, "EBUSY") : 0;
    case VIDIOC_STREAMOFF:
        return 0;
    case VIDIOC_STREAMON:
        return says("EBUSY") ? refuse(EBUSY, "EBUSY") : refuse(ENOSPC, "ENOSPC");
    default:
        errno = ENOTTY;
        return -1;
    }
}
